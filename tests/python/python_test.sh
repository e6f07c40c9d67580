# SPDX-License-Identifier: MIT
# Runs the tests of the Python package, out of the tree.
set -eu
python=/usr/bin/python3
[[ -x $python ]] || python=python3
"$python" -c 'import cffi, numpy, pytest' 2>/dev/null || { echo "not tested: python3-cffi, python3-numpy and python3-pytest are missing"; exit 77; }
PYTHONPATH=$SOURCE/python PYTHONDONTWRITEBYTECODE=1 exec "$python" -m pytest -q -p no:cacheprovider "$SOURCE/python/tests" "$@"
