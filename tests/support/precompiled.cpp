// Empty: what matters are the headers that are precompiled with it (tests/CMakeLists.txt).
