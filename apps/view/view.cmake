# SPDX-License-Identifier: Apache-2.0
# `tetralux view`: state and commands in a library of their own, without engines.
add_library(tetralux_view_state STATIC view/camera_moves.cpp view/option_words.cpp view/transfer_nodes.cpp view/view_state.cpp)
target_link_libraries(tetralux_view_state PUBLIC tetralux_projection PRIVATE fmt::fmt)
target_sources(tetralux PRIVATE view/picture.cpp view/render_words.cpp view/view_command.cpp view/view_script.cpp)
target_link_libraries(tetralux PRIVATE tetralux_view_state)
