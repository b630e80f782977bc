@echo off
rem Installs what Roofslip needs on the first call, then runs it: .\roofslip report projects\example
rem Python packages go into .venv beside this file, from requirements.lock with hashes; uv, if it is not
rem installed, and its Python go into the user's own folders. Nothing needs an administrator.
setlocal
set "here=%~dp0"
set "here=%here:~0,-1%"
set "VIRTUAL_ENV=%here%\.venv"
set "python=%VIRTUAL_ENV%\Scripts\python.exe"

rem Python would read the name of a folder with accents from .venv in another code page.
set "PYTHONPATH=%here%"
rem Python keeps what it compiles when it first imports a module: the set-up compiles none.
set "PYTHONDONTWRITEBYTECODE="
set "PYTHONUTF8=1"
rem The matrices are small: more threads are slower.
set "OPENBLAS_NUM_THREADS=1"
rem The program as it can be typed in the current folder.
set "ROOFSLIP_COMMAND=%here%\roofslip"
if /i "%CD%"=="%here%" set "ROOFSLIP_COMMAND=.\roofslip"

call :print_help %*
if not errorlevel 1 exit /b 0
rem These need more than their name.
set "alone="
for %%c in (check report watch new plan motion slide study sign verify-package completion) do if "%~1 %~2"=="%%c " set "alone=yes"
if defined alone call :print_help %1 --help
if defined alone exit /b 2
if "%~1"=="test" goto test
call :is_set_up test
if errorlevel 1 call :is_set_up commands
if errorlevel 1 call :set_up commands
if not errorlevel 1 goto run
rem Of a double click, the window would close with what it says.
if "%~1"=="" pause
exit /b 1

rem A double click gives no arguments, and opens the page in the browser.
:run
if "%~1"=="" "%python%" -P -m report.cli serve
if not "%~1"=="" "%python%" -P -m report.cli %*
exit /b %errorlevel%

rem The tests of every day; with a path, all tests there.
:test
set "ROOFSLIP_COMMAND="
call :is_set_up test
if errorlevel 1 call :set_up test
if errorlevel 1 exit /b 1
cd /d "%here%"
if "%~2"=="" "%python%" -m pytest --numprocesses 2 --dist worksteal -m "not nightly"
if not "%~2"=="" "%python%" -m pytest %2 %3 %4 %5 %6 %7 %8 %9
exit /b %errorlevel%

rem The help of a command, or the version, where that is asked for: from files, so that nothing needs to be
rem installed for it. Without empty lines, which this shell passes over.
:print_help
set "asked="
set "words="
:next_word
if "%~1"=="" goto asked
if "%~1"=="--" goto asked
if "%~1"=="-h" set "asked=help"
if "%~1"=="--help" set "asked=help"
if "%~1"=="--version" if not defined words set "asked=version"
if defined asked goto asked
set "word=%~1"
if not "%word:~0,1%"=="-" set "words=%words% %word%"
shift
goto next_word

:asked
if not defined asked exit /b 1
if "%asked%"=="version" goto version
for /f "tokens=1,2" %%a in ("%words% roofslip") do (
    set "title=## %%a %%b"
    call :print_section 2>nul
    if not errorlevel 1 exit /b 0
    set "title=## %%a"
)
call :print_section 2>nul
exit /b %errorlevel%

:print_section
set "found="
set "is_it="
set "inside="
for /f "usebackq delims=" %%a in ("%here%\docs\commands.md") do (
    if "%%a"=="```" set "inside="
    if defined inside echo %%a
    if "%%a"=="```text" if defined is_it set "inside=1"
    if "%%a"=="```text" set "is_it="
    if "%%a"=="%title%" set "is_it=1"
    if defined inside set "found=1"
)
if defined found exit /b 0
exit /b 1

rem Of which commit it is, the program knows.
:version
call :is_set_up test
if not errorlevel 1 exit /b 1
call :is_set_up commands
if not errorlevel 1 exit /b 1
for /f "usebackq tokens=1,3" %%a in ("%here%\pyproject.toml") do if "%%a"=="version" echo roofslip, version %%~b
exit /b 0

rem A set is kept with the files that it was installed from.
:is_set_up
set "same=all(cmp(f'{here}/{name}', f'{here}/.venv/set-up-%1/{name}', False) for name in names)"
"%python%" -c "import sys; from filecmp import cmp; here, *names = sys.argv[1:]; sys.exit(not %same%)" "%here%" requirements.lock pyproject.toml 2>nul
exit /b %errorlevel%

:set_up
set "need=%1"
if exist "%here%\.venv\set-up-test" set "need=test"
mkdir "%here%\.venv-try" 2>nul
if not exist "%here%\.venv-try" goto not_written
rmdir "%here%\.venv-try" 2>nul
set "lock=%here%\.venv-lock"
set "ran="
rem One after the other: the file is open as long as a set-up runs, and no other call can open it.
:wait
set "opened="
call :open 2>nul
if defined opened call :locked %1 9>"%lock%"
if defined ran goto unlocked
echo roofslip: another call is setting up .venv; waiting for it 1>&2
ping -n 6 127.0.0.1 >nul
goto wait

:unlocked
del "%lock%" 2>nul
exit /b %ran%

:not_written
echo roofslip: packages go into %here%, which cannot be written: copy it to a folder of your own, or have 1>&2
echo its owner run this command once. Nothing was changed. 1>&2
exit /b 1

:open
call :opened 9>"%lock%"
exit /b 0

:opened
set "opened=yes"
exit /b 0

rem What another call has set up meanwhile is enough.
:locked
call :is_set_up %1
if errorlevel 1 call :install
set "ran=%errorlevel%"
exit /b %ran%

rem A new set is made beside the former one, and takes its place once it is whole.
:install
rem Where uv and pip install is said here alone.
for %%v in (UV_SYSTEM_PYTHON UV_BREAK_SYSTEM_PACKAGES UV_PYTHON UV_TARGET UV_PREFIX UV_PROJECT) do set "%%v="
for %%v in (UV_WORKING_DIR PIP_TARGET PIP_PREFIX PIP_ROOT PIP_PYTHON) do set "%%v="
set "PIP_USER=0"
set "PIP_REQUIRE_VIRTUALENV=0"
call :find_uv
if errorlevel 1 exit /b 1
if "%need%"=="test" set "megabytes=500"
if not "%need%"=="test" set "megabytes=300"
echo roofslip: setting up .venv from requirements.lock (once, for %need%; downloads about %megabytes% MB) 1>&2
rem There: uv takes a path with a space for two.
pushd "%here%"
set "new=.venv-new"
"%uv%" venv --quiet --clear --relocatable --python 3.11 %new%
if errorlevel 1 goto ask
if "%need%"=="test" "%uv%" pip sync --python %new% --require-hashes requirements.lock
if not "%need%"=="test" "%uv%" pip install --python %new% --require-hashes --all-extras -r pyproject.toml --group build -c requirements.lock
if errorlevel 1 goto ask
"%uv%" pip install --python %new% --quiet --no-deps --no-build-isolation -e .
if errorlevel 1 goto ask
echo roofslip: compiling the solver (once) 1>&2
set "NUMBA_OPT=2"
%new%\Scripts\python.exe -P -m solver.sliding.checked constant law
if errorlevel 1 exit /b 1
set "NUMBA_OPT="
mkdir %new%\set-up-%need%
for %%f in (requirements.lock pyproject.toml) do copy /y %%f %new%\set-up-%need% >nul
if exist .venv-old rmdir /s /q .venv-old
if exist .venv ren .venv .venv-old
if exist .venv goto in_use
ren %new% .venv
if exist .venv-old rmdir /s /q .venv-old
popd
exit /b 0

:in_use
echo roofslip: a program uses what is in .venv, as the page does: end it, then run this again. Nothing was changed. 1>&2
exit /b 1

rem uv from the PATH, else one version from its makers, else the same by pip; both have their SHA-256 checked.
:find_uv
set "uv=uv"
uv --version >nul 2>nul
if not errorlevel 1 exit /b 0
set "version=0.11.19"
set "folder=%LOCALAPPDATA%\roofslip\uv-%version%"
set "uv=%folder%\bin\uv.exe"
if exist "%uv%" exit /b 0
set "uv=%folder%\uv.exe"
if exist "%uv%" exit /b 0
echo roofslip: installing uv into %folder% 1>&2
set "address=https://github.com/astral-sh/uv/releases/download/%version%/uv-x86_64-pc-windows-msvc.zip"
set "sha256=1665FC8E37B5D70A134820D6D7891747471A2AC8BC940EE7AF0B69FD03B28D61"
set "load=$ErrorActionPreference = 'Stop'; $ProgressPreference = 'SilentlyContinue'"
set "load=%load%; [Net.ServicePointManager]::SecurityProtocol = 'Tls12'; $zip = $env:folder + '.zip'"
set "load=%load%; [void](New-Item -Force -ItemType Directory $env:folder)"
set "load=%load%; Invoke-WebRequest -UseBasicParsing $env:address -OutFile $zip"
set "load=%load%; if ((Get-FileHash $zip).Hash -ne $env:sha256) { throw 'its SHA-256 is another' }"
set "load=%load%; Expand-Archive -Force $zip $env:folder; Remove-Item $zip"
powershell -NoProfile -ExecutionPolicy Bypass -Command "%load%"
if exist "%uv%" exit /b 0
set "uv=%folder%\bin\uv.exe"
if exist "%uv%" exit /b 0
if not exist "%folder%" mkdir "%folder%"
>"%folder%\uv.txt" echo uv==%version% --hash=sha256:480fc34a8d0967af6a90b3f99a6e5687cd5c6e29528de96bec04d6e305a59363
py -m pip install --quiet --require-hashes --no-deps --only-binary :all: --target "%folder%" -r "%folder%\uv.txt"
if exist "%uv%" exit /b 0
:ask
if exist "%here%\.venv-new" rmdir /s /q "%here%\.venv-new"
echo roofslip: the set-up is not complete. If a download was refused, ask your IT to allow GitHub and the Python 1>&2
echo package index, or to install uv (winget install --id astral-sh.uv) with access to both. If a path was too long, 1>&2
echo move this folder to a shorter one. Then run this again. What was set up before works as it did. 1>&2
exit /b 1
