"""The scalar types that most tests run for."""

from typing import Any

import numpy as np
import pytest


@pytest.fixture(params=[np.float32, np.float64], ids=["float32", "float64"])
def scalar(request: pytest.FixtureRequest) -> Any:
    """float32 or float64."""
    return request.param
