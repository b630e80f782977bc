# docker build --tag roofslip .
# docker run --rm --volume "$PWD/projects:/projects" roofslip report yours
FROM debian:12-slim
ENV PATH=/opt/roofslip:$PATH NUMBA_CACHE_DIR=/var/cache/roofslip UV_COMPILE_BYTECODE=1 UV_NO_CACHE=1
COPY . /opt/roofslip
WORKDIR /opt/roofslip/projects
# As root the launcher installs what it needs, here the set with ObsPy, which has all others, and the
# commands try it. No versions: Debian keeps only the latest of a package.
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --yes --no-install-recommends ca-certificates python3-venv \
    && { roofslip motion info none.mseed; ../.venv/bin/python -c 'import obspy'; } \
    && roofslip study --dry-run study \
    && roofslip serve --once --port 0 \
    && useradd --uid 1000 --create-home roofslip \
    && chown --recursive roofslip "$NUMBA_CACHE_DIR" \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /projects
USER 1000
ENTRYPOINT ["roofslip"]
CMD ["--help"]
