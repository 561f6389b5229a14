# SPDX-License-Identifier: Apache-2.0
"""vtkTetraluxMapper for the VTK that it was built with."""

from .vtkTetraluxVolume import vtkTetraluxMapper

__all__ = ["vtkTetraluxMapper"]
