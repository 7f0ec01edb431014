narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/kernels_scalar.cpp.o: \
 ../../../../../narrowphase/kernels/kernels_scalar.cpp \
 /usr/include/stdc-predef.h ../../../../../narrowphase/kernels/kernels.h \
 ../../../../../engine/base/include/tact/facet_pair.h \
 /usr/include/c++/12/compare /usr/include/c++/12/concepts \
 /usr/include/c++/12/type_traits \
 /usr/include/x86_64-linux-gnu/c++/12/bits/c++config.h \
 /usr/include/x86_64-linux-gnu/c++/12/bits/os_defines.h \
 /usr/include/features.h /usr/include/features-time64.h \
 /usr/include/x86_64-linux-gnu/bits/wordsize.h \
 /usr/include/x86_64-linux-gnu/bits/timesize.h \
 /usr/include/x86_64-linux-gnu/sys/cdefs.h \
 /usr/include/x86_64-linux-gnu/bits/long-double.h \
 /usr/include/x86_64-linux-gnu/gnu/stubs.h \
 /usr/include/x86_64-linux-gnu/gnu/stubs-64.h \
 /usr/include/x86_64-linux-gnu/c++/12/bits/cpu_defines.h \
 /usr/include/c++/12/pstl/pstl_config.h /usr/include/c++/12/cstdint \
 /usr/lib/gcc/x86_64-linux-gnu/12/include/stdint.h /usr/include/stdint.h \
 /usr/include/x86_64-linux-gnu/bits/libc-header-start.h \
 /usr/include/x86_64-linux-gnu/bits/types.h \
 /usr/include/x86_64-linux-gnu/bits/typesizes.h \
 /usr/include/x86_64-linux-gnu/bits/time64.h \
 /usr/include/x86_64-linux-gnu/bits/wchar.h \
 /usr/include/x86_64-linux-gnu/bits/stdint-intn.h \
 /usr/include/x86_64-linux-gnu/bits/stdint-uintn.h \
 ../../../../../narrowphase/kernels/kernels.inl \
 ../../../../../narrowphase/kernels/bytes.inl \
 ../../../../../narrowphase/kernels/facets.inl \
 ../../../../../narrowphase/kernels/pair_lanes.inl \
 ../../../../../narrowphase/kernels/clear_pairs.inl \
 ../../../../../narrowphase/kernels/exact_pairs.inl \
 ../../../../../narrowphase/kernels/facet_pairs.inl \
 ../../../../../narrowphase/kernels/refresh.inl \
 ../../../../../narrowphase/kernels/sort.inl
