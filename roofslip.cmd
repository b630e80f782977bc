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

rem A set is kept with the files that it was installed from.
:is_set_up
set "same=all(cmp(f'{here}/{name}', f'{here}/.venv/set-up-%1/{name}', False) for name in names)"
"%python%" -c "import sys; from filecmp import cmp; here, *names = sys.argv[1:]; sys.exit(not %same%)" "%here%" requirements.lock pyproject.toml 2>nul
exit /b %errorlevel%

:set_up
call :find_uv
if errorlevel 1 exit /b 1
if "%1"=="test" set "megabytes=500"
if not "%1"=="test" set "megabytes=300"
echo roofslip: setting up .venv from requirements.lock (once, for %1; downloads about %megabytes% MB) 1>&2
rem There: uv takes a path with a space for two.
pushd "%here%"
"%uv%" venv --quiet --clear --python 3.11 .venv
if errorlevel 1 goto ask
if "%1"=="test" "%uv%" pip sync --require-hashes requirements.lock
if not "%1"=="test" "%uv%" pip install --require-hashes --all-extras -r pyproject.toml --group build -c requirements.lock
if errorlevel 1 goto ask
"%uv%" pip install --quiet --no-deps --no-build-isolation -e .
if errorlevel 1 exit /b 1
echo roofslip: compiling the solver (once) 1>&2
set "NUMBA_OPT=2"
"%python%" -P -m solver.sliding.checked constant law
if errorlevel 1 exit /b 1
set "NUMBA_OPT="
mkdir .venv\set-up-%1
for %%f in (requirements.lock pyproject.toml) do copy /y %%f .venv\set-up-%1 >nul
popd
exit /b 0

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
echo roofslip: the set-up is not complete. If a download was refused, ask your IT to allow GitHub and the Python 1>&2
echo package index, or to install uv (winget install --id astral-sh.uv) with access to both. If a path was too long, 1>&2
echo move this folder to a shorter one. Then run this again. 1>&2
exit /b 1
