"""The import of the package."""

import subprocess
import sys

import lcplab


def test_receipts_are_imported_with_the_first_use_of_one_of_their_names():
    script = (
        "import sys, lcplab; assert 'lcplab._receipt' not in sys.modules; "
        "lcplab.receipt; assert 'lcplab._receipt' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_every_public_name_is_an_attribute_and_is_listed():
    assert all(hasattr(lcplab, name) for name in lcplab.__all__)
    assert set(lcplab.__all__) <= set(dir(lcplab))
    assert not hasattr(lcplab, "no_such_name")
