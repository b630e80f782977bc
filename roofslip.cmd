@echo off
rem Installs what Roofslip needs on the first call, then runs it: .\roofslip report projects\example
rem Python packages go into .venv beside this file, from requirements.lock with hashes; uv, if it is not
rem installed, and its Python go into the user's own folders. Nothing needs an administrator.
setlocal
set "here=%~dp0"
set "here=%here:~0,-1%"
set "python=%here%\.venv\Scripts\python.exe"
rem Python would read the name of a folder with accents from .venv in another code page, and keeps what
rem it compiles when it first imports a module. Matrices are small: more threads are slower.
set "PYTHONPATH=%here%"
set "PYTHONHOME="
set "PYTHONPLATLIBDIR="
set "PYTHONINSPECT="
set "PYTHONDONTWRITEBYTECODE="
set "PYTHONUTF8=1"
set "OPENBLAS_NUM_THREADS=1"
rem The program as it can be typed in the current folder.
set "ROOFSLIP_COMMAND=%here%\roofslip"
if /i "%CD%"=="%here%" set "ROOFSLIP_COMMAND=.\roofslip"

rem Ready is what was installed from these files.
set "need=commands"
if "%~1"=="test" set "need=test"
if exist "%here%\.venv\set-up-test" set "need=test"
set "read=import sys; read = b''.join(open(name, 'rb').read() for name in sys.argv[2:])"
set files="%here%\.venv\set-up-%need%" "%here%\requirements.lock" "%here%\pyproject.toml"
"%python%" -c "%read%; sys.exit(open(sys.argv[1], 'rb').read() != read)" %files% 2>nul
if not errorlevel 1 goto run
set "code="
call :answer %*
if defined code exit /b %code%
call :set_up
if not errorlevel 1 goto run
rem A double click gives no arguments: it opens the page in the browser, and here the window would close.
if "%~1"=="" pause
exit /b 1

:run
if "%~1"=="test" goto test
if "%~1"=="" "%python%" -P -m report.cli serve
if not "%~1"=="" "%python%" -P -m report.cli %*
exit /b %errorlevel%

rem The tests of every day; with a path, all tests there.
:test
set "ROOFSLIP_COMMAND="
cd /d "%here%"
if "%~2"=="" "%python%" -m pytest --numprocesses 2 --dist worksteal -m "not nightly"
if not "%~2"=="" "%python%" -m pytest %2 %3 %4 %5 %6 %7 %8 %9
exit /b %errorlevel%

rem Sets code where it prints what needs nothing installed: version, help, that of a command without its file.
:answer
set "help="
set "words="
if "%~1"=="--version" set "help=0"
if "%~1"=="--version" set "words= version"
:next_word
set "word=%~1"
if not defined word goto words
if "%word%"=="-h" set "help=0"
if "%word%"=="--help" set "help=0"
if not "%word:~0,1%"=="-" set "words=%words% %word%"
shift
goto next_word
:words
for %%c in (check report watch new plan motion slide study sign verify-package completion) do if "%words%"==" %%c" if not defined help set "help=2"
if not defined help exit /b
for /f "tokens=1,2" %%a in ("%words% roofslip") do for %%f in ("%%a-%%b" "%%a") do if not defined code if exist "%here%\docs\help\%%~f.txt" type "%here%\docs\help\%%~f.txt"& set "code=%help%"
exit /b

rem uv downloads all before it changes anything, and of two calls one waits for the other.
:set_up
rem Where uv and pip install is said here alone.
for %%v in (UV_SYSTEM_PYTHON UV_BREAK_SYSTEM_PACKAGES UV_PYTHON UV_TARGET UV_PREFIX UV_PROJECT UV_WORKING_DIR PIP_TARGET PIP_PREFIX PIP_ROOT PIP_PYTHON) do set "%%v="
set "PIP_USER=0"
set "PIP_REQUIRE_VIRTUALENV=0"
call :find_uv
if errorlevel 1 goto ask
echo roofslip: setting up .venv from requirements.lock (once, for %need%; downloads 300 to 400 MB) 1>&2
rem There: uv takes a path with a space for two.
pushd "%here%"
if not exist "%python%" "%uv%" venv --quiet --allow-existing --relocatable --python 3.11 .venv
"%uv%" pip install --python .venv --require-hashes --all-extras -r pyproject.toml --group %need:commands=build% -c requirements.lock
if errorlevel 1 goto ask
"%uv%" pip install --python .venv --quiet --no-deps --no-build-isolation -e .
if errorlevel 1 goto ask
popd
echo roofslip: compiling the solver (once) 1>&2
set "NUMBA_OPT=2"
"%python%" -P -m solver.sliding.warm constant law
if errorlevel 1 exit /b 1
set "NUMBA_OPT="
"%python%" -c "%read%; open(sys.argv[1], 'wb').write(read)" %files%
exit /b 0

rem uv from the PATH, else one version from its makers, else the same by pip; both have their SHA-256 checked.
:find_uv
set "uv=uv"
uv --version >nul 2>nul
if not errorlevel 1 exit /b 0
set "version=0.11.19"
set "folder=%LOCALAPPDATA%\roofslip\uv-%version%"
call :is_uv
if exist "%uv%" exit /b 0
echo roofslip: installing uv into %folder% 1>&2
if not exist "%folder%" mkdir "%folder%"
set "address=https://github.com/astral-sh/uv/releases/download/%version%/uv-x86_64-pc-windows-msvc.zip"
set "sha256=1665FC8E37B5D70A134820D6D7891747471A2AC8BC940EE7AF0B69FD03B28D61"
set "load=$ErrorActionPreference = 'Stop'; $ProgressPreference = 'SilentlyContinue'; $zip = $env:folder + '.zip'"
set "load=%load%; [Net.ServicePointManager]::SecurityProtocol = 'Tls12'; Invoke-WebRequest -UseBasicParsing $env:address -OutFile $zip"
set "load=%load%; if ((Get-FileHash $zip).Hash -ne $env:sha256) { throw 'its SHA-256 is another' }; Expand-Archive -Force $zip $env:folder"
powershell -NoProfile -ExecutionPolicy Bypass -Command "%load%; Remove-Item $zip"
call :is_uv
if exist "%uv%" exit /b 0
>"%folder%\uv.txt" echo uv==%version% --hash=sha256:480fc34a8d0967af6a90b3f99a6e5687cd5c6e29528de96bec04d6e305a59363
py -m pip install --quiet --require-hashes --no-deps --only-binary :all: --target "%folder%" -r "%folder%\uv.txt"
:is_uv
for %%u in ("%folder%\bin\uv.exe" "%folder%\uv.exe") do if exist %%u set "uv=%%~u"
if exist "%uv%" exit /b 0
exit /b 1

:ask
echo roofslip: the set-up is not complete. If a download was refused, ask your IT to allow GitHub and the Python 1>&2
echo package index, or to install uv (winget install --id astral-sh.uv) with access to both. If a path was too long, 1>&2
echo move this folder to a shorter one. Then run this again. The existing installation still works. 1>&2
exit /b 1
