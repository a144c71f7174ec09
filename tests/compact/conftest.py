"""The helpers beside these tests are found by their names: `mullin`, `isomorphism`."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent))
