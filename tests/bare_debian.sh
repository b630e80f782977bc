#!/bin/sh
# Both commands of the README in a bare Debian 12: minbase, python3 and certificates.
# What is committed is run, as root. Arguments go to ./roofslip test:
#   sudo tests/bare_debian.sh [tests/solver/test_public.py ...]
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)

fail() {
    printf '%s\n' "$*" >&2
    exit 1
}

[ "$(id -u)" = 0 ] || fail "a root file system can be made by root only. Run: sudo $0"
PATH=$PATH:/usr/sbin:/sbin
for pair in debootstrap=debootstrap git=git unshare=util-linux; do
    command -v "${pair%%=*}" >/dev/null \
        || fail "${pair%%=*} is not installed. Run: sudo apt-get install ${pair#*=}"
done

top=$(mktemp -d)
root=$top/root
trap 'rm -rf --one-file-system "$top"' EXIT
trap 'exit 130' INT TERM

# Of the host's environment, the root gets only what leads to registries.
# shellcheck disable=SC2013
for name in $(awk 'BEGIN { for (name in ENVIRON) print name }'); do
    case $name in
        PATH | PIP_* | UV_* | SSL_CERT_* | *_proxy | *_PROXY) ;;
        *[!A-Za-z0-9_]*) ;; # a function of another shell
        *) unset "$name" ;;
    esac
done
export HOME=/root

make_root() {
    # The host's own mirror; on another system the default one.
    # shellcheck disable=SC2016
    mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' \
        'Codename: bookworm' 2>/dev/null | head -n 1)
    debootstrap --variant=minbase --include=python3,ca-certificates bookworm "$root" \
        ${mirror:+"$mirror"} >"$top/output" 2>&1 || { cat "$top/output"; fail "debootstrap failed"; }
    apt-config dump Acquire >"$root/etc/apt/apt.conf.d/90host" || true
    for file in /etc/hosts /etc/resolv.conf /etc/pip.conf /etc/ssl/certs/ca-certificates.crt; do
        [ ! -e "$file" ] || cp -L "$file" "$root$file"
    done
    mkdir "$root/roofslip"
    git -c safe.directory="$here" -C "$here" archive HEAD | tar -x -C "$root/roofslip"
}

# The mounts and all processes end with their name spaces. `|| exit` keeps the shell as process 1:
# it collects orphans, which Python would not.
inside() {
    # shellcheck disable=SC2016
    unshare --mount --pid --fork --kill-child sh -euc '
        cd "$1" && shift
        mount -t proc proc proc
        mount -t devpts devpts dev/pts
        mount -t tmpfs shm dev/shm
        chroot . sh -c "cd /roofslip && exec ./roofslip \"\$@\"" sh "$@" || exit
    ' sh "$root" "$@"
}

run() {
    code=0
    started=$(date +%s)
    inside "$@" >"$top/output" 2>&1 </dev/null || code=$?
    seconds=$(($(date +%s) - started))
    printf '$ ./roofslip %s\n' "$*"
    if [ "$code" = 0 ]; then
        grep '^roofslip: ' "$top/output" || true
        tail -n 10 "$top/output"
    else
        cat "$top/output"
        failed=1
    fi
    printf '%s s, exit code %s\n\n' "$seconds" "$code"
}

failed=0
make_root
run report projects/example
run test "$@"
exit "$failed"
