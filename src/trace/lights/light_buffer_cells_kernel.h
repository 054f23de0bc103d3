// In which cells of a light buffer points are.
#pragma once
#include "trace/forms/items_kernel.h"
#include "trace/lights/light_buffer.h"

namespace strahl::inline STRAHL_LEVEL {

/// The cells of points relative to a light; 0 where no body is in the way.
template <class S>
STRAHL_INLINE S cells_of(const LightBuffer<Element<S>>& buffer, bool parallel, const Vec3<S>& points, Mask<S> left) {
    S cells(0);
    for (int i = 0; i < buffer.face_count && any(left); ++i) {
        const BufferFace<Element<S>>& face = buffer.faces[i];
        S u = dot(splat<S>(face.right), points), v = dot(splat<S>(face.up), points);
        Mask<S> own = left;
        if (!parallel) {
            const S z = dot(splat<S>(face.axis), points), inverse = S(1) / z;
            u = u * inverse, v = v * inverse;
            own = own & (z > S(0)) & (abs(u) <= S(face.limit)) & (abs(v) <= S(face.limit));
        }
        left = left & !own;
        const S column = floor((u - S(face.low_u)) * S(face.per_u));
        const S row = floor((v - S(face.low_v)) * S(face.per_v));
        own = own & (column >= S(0)) & (column < S(face.columns)) & (row >= S(0)) & (row < S(face.rows));
        cells = select(own, fma(row, S(face.columns), column) + S(face.first), cells);
    }
    return cells;
}

}  // namespace strahl::inline STRAHL_LEVEL
