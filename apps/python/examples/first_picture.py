# SPDX-License-Identifier: Apache-2.0
"""A picture in three lines."""

import tetralux

mesh = tetralux.read("bucky:32")
tetralux.render(mesh, size=(512, 512)).save("first_picture.png")
