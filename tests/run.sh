# The end of ./roofslip test, which reads this file: checks and tests, with what is installed in .venv.
# shellcheck shell=sh disable=SC2154

# Runs all tests under coverage, those of the kernels once more with the compiler off: they run every
# line of these, and all together the share of the product that pyproject.toml says.
run_nightly() {
    failed=0
    coverage erase
    coverage run -m pytest --numprocesses 2 --dist worksteal || failed=1
    NUMBA_DISABLE_JIT=1 coverage run -m pytest --ignore tests/solver/kernels/test_compiler.py tests/solver/kernels || failed=1
    # What a killed process wrote in part is left out, with a warning.
    coverage combine --quiet || failed=1
    coverage report --include 'solver/kernels/*' --omit solver/kernels/compiler.py --fail-under 100 || failed=1
    coverage report || failed=1
    exit $failed
}

# It recalculates the formulas of the workbook; without it those tests are skipped.
command -v soffice >/dev/null 2>&1 || apt_install libreoffice-calc \
    || say "tests of formulas are skipped without LibreOffice. Run: sudo apt-get install libreoffice-calc"
# The page is tested in a real browser, likewise; the node of Playwright drives it.
look_up libatomic.so.1=libatomic1
command -v chromium >/dev/null 2>&1 || missing="$missing chromium"
# shellcheck disable=SC2086
[ -z "$missing" ] || apt_install $missing \
    || say "tests of the page are skipped without a browser. Run: sudo apt-get install$missing"
# Windows' own Python, which Maven brings, runs under Wine.
if [ "${2-}" = --nightly ]; then
    missing=''
    [ -x /usr/lib/wine/wine64 ] || missing='wine wine64'
    command -v mvn >/dev/null 2>&1 || missing="$missing maven"
    # They build the kernels of calc-package.html again, and open it in another browser.
    command -v wasm-ld-14 >/dev/null 2>&1 || missing="$missing lld-14"
    command -v firefox-esr >/dev/null 2>&1 || missing="$missing firefox-esr"
    # shellcheck disable=SC2086
    [ -z "$missing" ] || apt_install $missing \
        || say "tests on Windows' Python, in Firefox and of LLD are skipped. Run: sudo apt-get install $missing"
fi
shift
unset ROOFSLIP_COMMAND # the tests expect the usual name
cd "$here"
PATH=$venv/bin:$PATH
ruff check --quiet .
ruff format --check --quiet .
git ls-files -z 2>/dev/null | xargs -0 -r codespell
oxlint --deny-warnings --config tests/oxlint.json report/web/static report/page_file/static
mypy
lint-imports
if command -v hadolint >/dev/null; then hadolint Dockerfile; fi # of the night's set
# Two processes of tests would compile the same kernels at once. As set-up does, at a level of
# optimization that takes three quarters of the time.
if ! ls solver/kernels/__pycache__/row.slide_row-*.nbi >/dev/null 2>&1; then
    NUMBA_OPT=2 python -P tests/compile_kernels.py axis &
    NUMBA_OPT=2 python -P tests/compile_kernels.py more
    wait "$!"
fi
# --quick: the inner loop; --nightly: all, with coverage; --golden: what changed in the words of
# pages, taken over. With a path, all tests there, or those that --quick or --nightly names.
case ${1-} in
--quick) shift && set -- -m 'quick and not nightly' "$@" ;;
--nightly) shift && { [ $# -gt 0 ] || run_nightly; } && set -- -m nightly "$@" ;;
--golden)
    shift
    study=tests/report/study/test_study.py::test_a_study_has_the_words_that_it_had
    set -- --golden tests/report/package/test_golden.py $study "$@"
    ;;
*) case " $*" in *[\ /]tests*) ;; *) set -- -m 'not nightly' "$@" ;; esac ;;
esac
exec pytest --numprocesses 2 --dist worksteal "$@"
