"""Released defects of physics engines, replayed from pinned packages: ``python -m lcplab.defects``.

Each has a release that was wrong and one that is mended. Both step the same scene, each in an environment of its own,
and :func:`lcplab.receipts` judges the frames with default arguments.
"""

from lcplab.defects.known import DEFECTS, Defect

__all__ = ["DEFECTS", "Defect"]
