include(${CMAKE_CURRENT_LIST_DIR}/slipfrontTargets.cmake)
