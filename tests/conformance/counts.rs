//! Compares each method's operation counts, derived by hand from the lecture's formulas, with the
//! counts of the counting backend.
//!
//! Hand counts are written like the formulas: dot products, reflections and so on. The material's
//! shininess is 32.

use crate::support::floats;
use fastphong::number::Counts;
use fastphong::shading::{MethodRow, OperationCounts, Variant};

/// Counts of additions, multiplications, divisions, roots, comparisons and trigonometric functions.
#[derive(Clone, Copy)]
struct Ops([u32; 6]);

impl std::ops::Add for Ops {
    type Output = Ops;
    fn add(self, other: Ops) -> Ops {
        Ops(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl std::ops::Mul<Ops> for u32 {
    type Output = Ops;
    fn mul(self, ops: Ops) -> Ops {
        Ops(ops.0.map(|n| self * n))
    }
}

impl PartialEq<Ops> for Counts {
    fn eq(&self, other: &Ops) -> bool {
        let found = [
            self.additions,
            self.multiplications,
            self.divisions,
            self.roots,
            self.comparisons,
            self.trigonometric,
            self.powers,
        ];
        let [a, m, d, r, c, t] = other.0;
        found == [a, m, d, r, c, t, 0]
    }
}

const NONE: Ops = Ops([0; 6]);
const ADD: Ops = Ops([1, 0, 0, 0, 0, 0]);
const MULTIPLY: Ops = Ops([0, 1, 0, 0, 0, 0]);
const DIVIDE: Ops = Ops([0, 0, 1, 0, 0, 0]);
const ROOT: Ops = Ops([0, 0, 0, 1, 0, 0]);
const COMPARE: Ops = Ops([0, 0, 0, 0, 1, 0]);
const TRIGONOMETRIC: Ops = Ops([0, 0, 0, 0, 0, 1]);

/// A dot product of three components.
const DOT: Ops = Ops([2, 3, 0, 0, 0, 0]);

/// Counts the terms of one light (2.1) after L·N and R·V. The diffuse term clamps L·N at 0. The
/// highlight is dropped behind the surface, compared with the faintest one, and raised to the power
/// 32 by five squarings. Each term needs a product and a sum per channel.
fn light() -> Ops {
    3 * COMPARE + 3 * (MULTIPLY + ADD) + 5 * MULTIPLY + 3 * (MULTIPLY + ADD)
}

/// Counts R·V of one light from L·N and V·N of a unit normal: 2 V·N, times L·N, less L·V (4.5).
fn highlight() -> Ops {
    2 * MULTIPLY + ADD
}

/// Counts L·N and R·V of one light from a unit normal: L·N, then R = 2 (L·N) N − L, then R·V.
fn cosines_from_normal() -> Ops {
    let reflect = MULTIPLY + 3 * (MULTIPLY + ADD);
    DOT + reflect + DOT
}

/// Counts one light from a unit normal.
fn lit_from_normal() -> Ops {
    cosines_from_normal() + light()
}

/// Counts the clamp of a colour to 0..=1: two comparisons per channel.
fn clamp() -> Ops {
    3 * 2 * COMPARE
}

/// Counts the set-up of one linearly interpolated value: (I_2 − I_1), times t0 and added to I_1,
/// and times Δt (3.5).
fn ramp() -> Ops {
    ADD + MULTIPLY + ADD + MULTIPLY
}

/// Counts the set-up of a great circle (4.7): both chords and their lengths, and the angle as twice
/// an inverse tangent. The sine follows from the chords. Then one division scales both ends.
fn arc() -> Ops {
    let chords = 3 * ADD + 3 * ADD + DOT + ROOT + DOT + ROOT;
    let angle = TRIGONOMETRIC + ADD;
    let sine = 2 * MULTIPLY;
    chords + angle + sine + DIVIDE + 2 * (3 * MULTIPLY)
}

/// Counts the start of the sines: the angles t0 φ, φ − t0 φ and Δt φ, and the sine and cosine of
/// each.
fn sines() -> Ops {
    3 * MULTIPLY + ADD + 3 * TRIGONOMETRIC
}

/// Counts a step of the four sines and cosines (4.9–4.12) as the lecture does: four additions and
/// eight multiplications.
fn rotation() -> Ops {
    4 * ADD + 8 * MULTIPLY
}

/// Counts a normal blended from two others by the weights of (4.8).
fn weighted_normal() -> Ops {
    3 * (2 * MULTIPLY + ADD)
}

/// Counts the choice of Newton steps for a span. It computes N·ΔN and ΔN·ΔN, the product N·N ΔN·ΔN
/// less the square of N·ΔN if that is below 0, and the square of ΔN·ΔN. Each threshold that it
/// tries takes a product, a difference and a comparison.
fn fewest_steps(tried: u32) -> Ops {
    2 * DOT + COMPARE + 3 * MULTIPLY + ADD + tried * (MULTIPLY + ADD + COMPARE)
}

struct ByHand {
    vertex: Ops,
    polygon: Ops,
    edge: Ops,
    edge_step: Ops,
    span: Ops,
    walk: Ops,
    shade: Ops,
}

impl ByHand {
    /// Subtracts operations from a pixel's shading.
    fn less(mut self, ops: Ops) -> ByHand {
        self.shade = Ops(std::array::from_fn(|i| self.shade.0[i] - ops.0[i]));
        self
    }
}

/// Returns the hand count of a method with default parameters and `lights` lights.
fn by_hand(method: &str, lights: u32) -> ByHand {
    let lit = lights * lit_from_normal();
    match method {
        // 2: one colour per polygon.
        "flat" => ByHand {
            vertex: NONE,
            polygon: lit + clamp(),
            edge: NONE,
            edge_step: NONE,
            span: NONE,
            walk: NONE,
            shade: NONE,
        },
        // CS171, Algorithm 6: normalise the mean normal, then compute one colour.
        "flat-average" => ByHand {
            vertex: NONE,
            polygon: DOT + ROOT + DIVIDE + 3 * MULTIPLY + lit + clamp(),
            edge: NONE,
            edge_step: NONE,
            span: NONE,
            walk: NONE,
            shade: NONE,
        },
        // 3: three channels from clamped vertex colours.
        "gouraud" => ByHand {
            vertex: lit + clamp(),
            polygon: NONE,
            edge: 3 * ramp(),
            edge_step: 3 * ADD,
            span: 3 * ramp(),
            walk: 3 * ADD,
            shade: NONE,
        },
        // 3 with two colours, from one lighting computation and unclamped. Each pixel adds the two.
        "gouraud-separate" => ByHand {
            vertex: lit,
            polygon: NONE,
            edge: 6 * ramp(),
            edge_step: 6 * ADD,
            span: 6 * ramp(),
            walk: 6 * ADD,
            shade: 3 * ADD,
        },
        // 4.1: step three coordinates, then |N|, its inverse, three products, and all of 2.1.
        "naive-phong" => ByHand {
            vertex: NONE,
            polygon: NONE,
            edge: 3 * ramp(),
            edge_step: 3 * ADD,
            span: 3 * ramp(),
            walk: 3 * ADD,
            shade: DOT + ROOT + DIVIDE + 3 * MULTIPLY + lit,
        },
        // 4.2, 4.3: step J of each light, K and three coordinates. A Newton step takes x², minus
        // d², x + x, a quotient and a difference. A pixel takes 1/d and 2K/D once, then J/d and
        // 2JK/D − L·V for each light.
        "fast-phong" => {
            let numbers = lights + 4;
            let newton = MULTIPLY + ADD + ADD + DIVIDE + ADD;
            ByHand {
                vertex: (lights + 1) * DOT,
                polygon: NONE,
                edge: numbers * ramp(),
                edge_step: numbers * ADD,
                span: numbers * ramp() + DOT + ROOT + fewest_steps(1),
                walk: numbers * ADD + DOT + newton,
                shade: DIVIDE + MULTIPLY + DIVIDE + lights * (MULTIPLY + MULTIPLY + ADD + light()),
            }
        }
        // The processor's reciprocal root counts as a root and a quotient. The rest equals Duff's
        // method.
        "fast-phong-rsqrt" => by_hand("duff-phong", lights),
        // Step three coordinates as in naive Phong. A pixel takes D, K and J of each light as dot
        // products, the root as above, K and each J times that root, and 2JK − L·V for each light.
        "phong-rsqrt" => ByHand {
            vertex: NONE,
            polygon: NONE,
            edge: 3 * ramp(),
            edge_step: 3 * ADD,
            span: 3 * ramp(),
            walk: 3 * ADD,
            shade: (lights + 2) * DOT
                + ROOT
                + DIVIDE
                + (lights + 1) * MULTIPLY
                + lights * (highlight() + light()),
        },
        // Duff 1979: J of each light, K and three coordinates are interpolated along edges. Along a
        // span J and K take one addition each, and D = N·N takes two. The set-up of D takes N·N,
        // N·ΔN twice, ΔN·ΔN, and its first and second difference. A pixel takes 1/√D, K and each J
        // times that, then 2JK − L·V for each light.
        "duff-phong" => {
            let numbers = lights + 4;
            ByHand {
                vertex: (lights + 1) * DOT,
                polygon: NONE,
                edge: numbers * ramp(),
                edge_step: numbers * ADD,
                span: numbers * ramp() + 3 * DOT + ADD + 2 * ADD,
                walk: (lights + 1) * ADD + 2 * ADD,
                shade: ROOT + DIVIDE + (lights + 1) * MULTIPLY + lights * (highlight() + light()),
            }
        }
        // As Duff's method, but 1/√D takes two steps of Newton's method from the previous pixel:
        // D/2, and in each step times r twice, 3/2 less that, times r. A span also computes 1/√D of
        // its first pixel, and chooses its steps: the product D ΔN·ΔN less the square of N·ΔN if
        // that is below 0, the square of ΔN·ΔN, and a product, a difference and a comparison for
        // each step count that it tries.
        "duff-newton" => {
            let duff = by_hand("duff-phong", lights);
            let choice = COMPARE + 3 * MULTIPLY + ADD + 2 * (MULTIPLY + ADD + COMPARE);
            ByHand {
                span: duff.span + choice + ROOT + DIVIDE,
                walk: duff.walk + MULTIPLY + 2 * (3 * MULTIPLY + ADD),
                shade: (lights + 1) * MULTIPLY + lights * (highlight() + light()),
                ..duff
            }
        }
        // Seiler 1998: J of each light and K at three corners, and at three edges with the
        // normalised mean of two normals. They make a quadratic in two coordinates, which a span
        // starts at its first pixel and which takes two additions per pixel.
        "six-point" => {
            let products = lights + 1;
            let midway = 3 * (3 * ADD + DOT + ROOT + DIVIDE + 3 * MULTIPLY);
            let area = 4 * ADD + 2 * MULTIPLY + ADD + DIVIDE + 4 * MULTIPLY;
            let weighted = 3 * 3 * MULTIPLY;
            // The coefficients of b, c, b², bc and c²: four products and three sums of the six
            // values, or three and two.
            let of_corners = 4 * (3 * MULTIPLY + 2 * ADD) + (4 * MULTIPLY + 3 * ADD);
            // The coefficients of x and y take two products and a sum each, those of x², xy and y²
            // three and two.
            let of_screen = 2 * (2 * MULTIPLY + ADD) + 3 * (3 * MULTIPLY + 2 * ADD);
            let squares = 12 * MULTIPLY + ADD;
            let start = 8 * ADD + 7 * MULTIPLY;
            ByHand {
                vertex: NONE,
                polygon: midway
                    + area
                    + weighted
                    + 6 * products * DOT
                    + products * (of_corners + of_screen)
                    + squares,
                edge: 3 * ramp(),
                edge_step: 3 * ADD,
                span: 2 * ADD + products * start,
                walk: 2 * products * ADD,
                shade: lights * (highlight() + light()),
            }
        }
        // US patent 5,369,737: a span starts J of each light, K and D from N and ΔN. A pixel
        // evaluates the parabola with two products and two sums, and multiplies J and K by it. The
        // choice of the polynomial is not counted.
        "series-phong" => {
            let products = lights + 1;
            ByHand {
                span: 3 * ramp() + 2 * products * DOT + 3 * DOT + ADD + 2 * ADD,
                walk: products * ADD + 2 * ADD,
                shade: 2 * (MULTIPLY + ADD)
                    + products * MULTIPLY
                    + lights * (highlight() + light()),
                ..by_hand("phong-rsqrt", lights)
            }
        }
        // The line of series-phong times J and K gives cubics: six products and two sums set one
        // up, a product and four sums its differences.
        "cubic-phong" => {
            let products = lights + 1;
            let line = 3 * DOT + ADD + (MULTIPLY + ADD) + 2 * MULTIPLY;
            let cubic = 6 * MULTIPLY + 2 * ADD + MULTIPLY + 4 * ADD;
            ByHand {
                span: 3 * ramp() + 2 * products * DOT + line + products * cubic,
                walk: 3 * products * ADD,
                shade: lights * (highlight() + light()),
                ..by_hand("phong-rsqrt", lights)
            }
        }
        // Lyon 1993: J of each light and K, D + 1 and its growth; for each light 1/|L + V| twice,
        // and 2 N·H and its growth, which subtracted from D + 1 start E. A pixel steps J by one
        // addition and E by two, and computes 1 − E/2. The scene that counts has R·V, so 1/|L + V|
        // is known.
        "difference-vector" => {
            let products = lights + 1;
            let difference = MULTIPLY + 2 * (ADD + MULTIPLY) + 2 * ADD + 2 * ADD;
            ByHand {
                span: 3 * ramp() + 2 * products * DOT + 3 * DOT + 2 * ADD + lights * difference,
                walk: lights * ADD + 2 * lights * ADD,
                shade: lights * (MULTIPLY + ADD + light()),
                ..by_hand("phong-rsqrt", lights)
            }
        }
        // Bishop, Weimer 1986: the normal in the middle and its growth, D and its five derivatives,
        // the series of 1/√D, and its product with the linear J of each light and K. Spans and
        // pixels are like six-point's.
        "bishop-weimer" => {
            let six = by_hand("six-point", lights);
            let area = 4 * ADD + 2 * MULTIPLY + ADD + DIVIDE + 4 * MULTIPLY;
            let normals = 3 * 3 * MULTIPLY + 2 * 3 * ADD + 3 * MULTIPLY + 2 * 3 * ADD;
            let growth = 2 * (2 * 3 * MULTIPLY + 3 * ADD);
            let square = 6 * DOT + 3 * ADD;
            let root = DIVIDE + 5 * MULTIPLY + ROOT + 2 * 2 * MULTIPLY + 3 * (4 * MULTIPLY + ADD);
            let product = 3 * DOT + 12 * MULTIPLY + 6 * ADD;
            let middle = 2 * (2 * ADD + MULTIPLY);
            ByHand {
                polygon: area + normals + growth + square + root + (lights + 1) * product + middle,
                ..six
            }
        }
        // Hast, Barrera, Bengtsson 2002: three unit vectors, and their quadratic at the first
        // pixel. A pixel takes six additions, K and J of each light, and 2JK − L·V.
        "quadratic-normals" => {
            let units = 3 * (DOT + ROOT + DIVIDE + 3 * MULTIPLY) + 3 * ADD;
            let quadratic = 3 * (2 * MULTIPLY + 2 * ADD) + 3 * (MULTIPLY + 3 * ADD);
            let start = 2 * (MULTIPLY + ADD) + (3 * MULTIPLY + ADD) + 2 * MULTIPLY + 2 * ADD;
            ByHand {
                span: units + quadratic + 3 * start,
                walk: 2 * 3 * ADD,
                shade: (lights + 1) * DOT + lights * (highlight() + light()),
                ..by_hand("phong-rsqrt", lights)
            }
        }
        // van Overveld, Wyvill 1997: three corners times their squared weights, three unit normals
        // half-way, reflected and weighted, and the quadratics of three components. A pixel takes
        // six additions, 1/|N|, K and J of each light times it, and 2JK − L·V.
        "biquadratic-normals" => {
            let area = 4 * ADD + 2 * MULTIPLY + ADD + DIVIDE + 4 * MULTIPLY;
            let corner = 4 * MULTIPLY;
            let unit = DOT + ROOT + DIVIDE + 3 * MULTIPLY;
            let reflected = 3 * 3 * ADD + 2 * DOT + MULTIPLY + DIVIDE + 3 * MULTIPLY + unit;
            let weighted = 4 * MULTIPLY + (6 * MULTIPLY + 3 * ADD) + ADD + 4 * MULTIPLY + 3 * ADD;
            let of_corners = 4 * (3 * MULTIPLY + 2 * ADD) + (4 * MULTIPLY + 3 * ADD);
            let of_screen = 2 * (2 * MULTIPLY + ADD) + 3 * (3 * MULTIPLY + 2 * ADD);
            let squares = 12 * MULTIPLY + ADD;
            let start = 8 * ADD + 7 * MULTIPLY;
            ByHand {
                polygon: area
                    + 3 * (corner + reflected + weighted)
                    + 3 * (of_corners + of_screen)
                    + squares,
                span: 2 * ADD + 3 * start,
                walk: 2 * 3 * ADD,
                shade: DOT
                    + ROOT
                    + DIVIDE
                    + (lights + 1) * (DOT + MULTIPLY)
                    + lights * (highlight() + light()),
                ..by_hand("phong-rsqrt", lights)
            }
        }
        // Harrison, Mitchell, Watt 1988: six values per vertex. The span that counts has a
        // highlight, so a pixel takes all operations of naive Phong with (4.5) except the diffuse
        // term.
        "h-test" => {
            let diffuse = COMPARE + 3 * (MULTIPLY + ADD);
            let specular = 3 * COMPARE + 5 * MULTIPLY + 3 * (MULTIPLY + ADD);
            let unit = DOT + ROOT + DIVIDE + 3 * MULTIPLY;
            ByHand {
                vertex: lights * (DOT + diffuse),
                polygon: NONE,
                edge: 6 * ramp(),
                edge_step: 6 * ADD,
                span: 6 * ramp(),
                walk: 6 * ADD,
                shade: unit + DOT + lights * (DOT + highlight() + specular),
            }
        }
        // One bright light: a parabola for 1/√D. A span starts J, K and D, which take one, one and
        // two additions per pixel. A pixel evaluates the parabola with two products and two sums,
        // multiplies J and K by it, and computes 2JK − L·V. Choosing the kind is not counted. Four
        // lights are all bright here, which is more than the method follows.
        "adaptive-phong" if lights == 1 => {
            let square = 3 * DOT + ADD + 2 * ADD;
            ByHand {
                span: 3 * ramp() + 4 * DOT + square,
                walk: 2 * ADD + 2 * ADD,
                shade: 2 * (MULTIPLY + ADD) + 2 * MULTIPLY + highlight() + light(),
                ..by_hand("phong-rsqrt", lights)
            }
        }
        "adaptive-phong" => by_hand("phong-rsqrt", lights),
        // Barrera, Hast, Bengtsson 2004: slerp whose span steps J of each light and K by ΔF −= α F.
        // The first ΔN takes sines of neighbours, from 1 − cos δ = sin² δ / (1 + cos δ).
        "slerp-chebyshev" => {
            let slerp = by_hand("slerp-phong", lights);
            let differences = (MULTIPLY + ADD + DIVIDE)
                + 2 * (2 * MULTIPLY + ADD)
                + 2 * 3 * MULTIPLY
                + 3 * ADD
                + ADD;
            ByHand {
                span: slerp.span + weighted_normal() + differences,
                walk: (lights + 1) * (MULTIPLY + 2 * ADD),
                ..slerp
            }
        }
        // 4.4: normals along edges. A span computes K and J of each light at both ends, then blends
        // them by the weights of (4.8). A pixel takes 2JK − L·V for each light.
        "slerp-phong" => ByHand {
            vertex: NONE,
            polygon: NONE,
            edge: arc() + sines(),
            edge_step: rotation(),
            span: 2 * weighted_normal() + arc() + sines() + 2 * (lights + 1) * DOT,
            walk: rotation() + (lights + 1) * (2 * MULTIPLY + ADD),
            shade: lights * (highlight() + light()),
        },
        // 4.4, steps i–iv: normals along edges and spans, then all of 2.1.
        "slerp-phong-vector" => ByHand {
            vertex: NONE,
            polygon: NONE,
            edge: arc() + sines(),
            edge_step: rotation(),
            span: 2 * weighted_normal() + arc() + sines(),
            walk: rotation() + weighted_normal(),
            shade: lit,
        },
        // As Duff's method, with M = N·H of each light in place of K. A highlight then takes no
        // product of J and K.
        "duff-half" => {
            let numbers = 2 * lights + 3;
            ByHand {
                vertex: 2 * lights * DOT,
                polygon: NONE,
                edge: numbers * ramp(),
                edge_step: numbers * ADD,
                span: numbers * ramp() + 3 * DOT + ADD + 2 * ADD,
                walk: 2 * lights * ADD + 2 * ADD,
                shade: ROOT + DIVIDE + lights * (2 * MULTIPLY + light()),
            }
        }
        // A vertex turns its normal into the frame of eye and first light. There K is a component,
        // and J of the first light takes two products.
        "eye-frame-phong" => {
            let phong = by_hand("phong-rsqrt", lights);
            let products = lights * DOT + (lights + 1) * MULTIPLY;
            ByHand {
                vertex: 3 * DOT,
                shade: DOT + ROOT + DIVIDE + products + lights * (highlight() + light()),
                ..phong
            }
            .less(MULTIPLY + ADD)
        }
        // As naive Phong with J and K, without a root.
        "phong-unnormalised" => ByHand {
            shade: (lights + 1) * DOT + lights * (highlight() + light()),
            ..by_hand("phong-rsqrt", lights)
        },
        // As slerp-chebyshev, with M = N·H of each light in place of K. After the first ΔN and N
        // come 2 products per light.
        "slerp-half" => {
            let slerp = by_hand("slerp-chebyshev", lights);
            ByHand {
                span: slerp.span + 2 * (lights - 1) * DOT,
                walk: 2 * lights * (MULTIPLY + 2 * ADD),
                shade: lights * light(),
                ..slerp
            }
        }
        // A vertex turns its normal and divides by 1 + z. A pixel takes u² + v² + 1 and a quotient
        // once, K by a difference, and for J of each light two products and sums, and one more.
        "stereographic-phong" => ByHand {
            vertex: 3 * DOT + ADD + DIVIDE + 2 * MULTIPLY,
            polygon: NONE,
            edge: 2 * ramp(),
            edge_step: 2 * ADD,
            span: 2 * ramp(),
            walk: 2 * ADD,
            shade: 2 * MULTIPLY
                + 2 * ADD
                + DIVIDE
                + ADD
                + lights * (3 * (MULTIPLY + ADD) + highlight() + light()),
        },
        // A vertex turns its normal, adds 1 to z and normalises. A pixel takes m·m, 2 m_z over it,
        // and K by a product and a difference; J of each light by a product with m (the first light
        // has no y), and one more.
        "quaternion-phong" => ByHand {
            vertex: 3 * DOT + ADD + DOT + ROOT + DIVIDE + 3 * MULTIPLY,
            shade: DOT
                + ADD
                + DIVIDE
                + MULTIPLY
                + ADD
                + lights * (DOT + MULTIPLY + ADD + highlight() + light()),
            ..by_hand("phong-rsqrt", lights)
        }
        .less(MULTIPLY + ADD),
        // A span normalises both ends and their sum, multiplied by the length of the last. M and
        // its growth follow, with their products and those of the first normal. A pixel takes q by
        // a sum and a quotient, and J of each light and K by a product and a difference.
        "half-reflection" => {
            let unit = DOT + ROOT + DIVIDE + 3 * MULTIPLY;
            let turned = 2 * unit + 3 * ADD + unit + DOT + 3 * MULTIPLY;
            let along = 3 * ADD + 3 * (MULTIPLY + ADD) + 3 * MULTIPLY;
            let square = 3 * DOT + ADD + 2 * ADD;
            ByHand {
                span: turned + along + 2 * DOT + square + 3 * (lights + 1) * DOT,
                walk: ADD
                    + 2 * ADD
                    + (lights + 1) * ADD
                    + ADD
                    + DIVIDE
                    + (lights + 1) * (MULTIPLY + ADD),
                shade: lights * (highlight() + light()),
                ..by_hand("naive-phong", lights)
            }
        }
        // A vertex turns its normal. A pixel takes 1 − x² − y², clamped at 0, and its root. J of
        // each light takes three products, J of the first light two.
        "phong-map" => ByHand {
            vertex: 3 * DOT,
            shade: 2 * MULTIPLY + 2 * ADD + COMPARE + ROOT + lights * (DOT + highlight() + light()),
            ..by_hand("stereographic-phong", lights)
        }
        .less(MULTIPLY + ADD),
        // Kuijk, Blake 1989: a span takes its angle, the normal in its middle and a unit vector
        // across. It takes the products of L and H of each light with both, an inverse tangent, a
        // root and a difference, and five squarings for the size of a highlight. A pixel takes two
        // additions per light, for each cosine a square, its position in the table and a product,
        // and for each highlight two parabolas.
        "kuijk-blake" => {
            let across = DOT + 3 * (MULTIPLY + ADD) + DOT + ROOT + COMPARE;
            let chords = 3 * ADD + 3 * ADD + DOT + ROOT + across + DOT + ROOT;
            let frame = TRIGONOMETRIC + 2 * DIVIDE + COMPARE + 2 * 3 * MULTIPLY;
            let angles = MULTIPLY + ADD + MULTIPLY + 2 * MULTIPLY;
            let wave = 2 * DOT + 2 * MULTIPLY + ADD + ROOT + TRIGONOMETRIC + ADD;
            let parabolas = (2 * COMPARE + ADD) + 2 * (ADD + COMPARE) + 4 * MULTIPLY + ADD;
            let gated = COMPARE;
            let colours = 6 * (MULTIPLY + ADD);
            ByHand {
                span: 2 * weighted_normal()
                    + chords
                    + frame
                    + angles
                    + lights * (2 * wave + 5 * MULTIPLY + 2 * COMPARE),
                walk: 2 * lights * ADD,
                shade: lights * (3 * MULTIPLY + COMPARE + parabolas + MULTIPLY + gated + colours),
                ..by_hand("slerp-phong", lights)
            }
        }
        _ => panic!("`{method}` is in METHODS and has no count by hand here"),
    }
}

#[test]
fn counts_agree_with_hand_counts() {
    let mut failures = Vec::new();
    for entry in floats() {
        for lights in [1, 4] {
            let (found, hand) = (
                entry.variant().operations(lights),
                by_hand(entry.info.name, lights as u32),
            );
            let rates = [
                ("vertex", found.vertex, hand.vertex),
                ("polygon", found.polygon, hand.polygon),
                ("edge", found.edge, hand.edge),
                ("edge step", found.edge_step, hand.edge_step),
                ("span", found.span, hand.span),
                ("walk", found.walk, hand.walk),
                ("shade", found.shade, hand.shade),
            ];
            for (rate, found, hand) in rates {
                let Ops(numbers) = hand;
                if found != hand {
                    let name = entry.info.name;
                    failures.push(format!(
                        "{name} with {lights} lights, {rate}: {found:?}, by hand {numbers:?}"
                    ));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn operations(variant: &str, lights: usize) -> OperationCounts {
    Variant::parse(variant)
        .expect("a method of the table")
        .operations(lights)
}

/// L21 3: "we can update I_next by a single addition per pixel". This holds for each of three
/// channels, with any count of lights.
#[test]
fn gouraud_takes_one_addition_per_channel() {
    for lights in [1, 4] {
        let counts = operations("gouraud", lights);
        assert!(counts.walk == 3 * ADD && counts.edge_step == 3 * ADD && counts.shade == NONE);
    }
}

/// L21 4.1: "we can update N_next by three additions (one for each coordinate) per pixel".
/// Renormalising and 2.1 come on top.
#[test]
fn naive_phong_steps_by_three_additions() {
    for lights in [1, 4] {
        let counts = operations("naive-phong", lights);
        assert!(counts.walk == 3 * ADD && counts.edge_step == 3 * ADD);
        assert_eq!((counts.shade.roots, counts.shade.divisions), (1, 1));
    }
}

/// L21 4.2–4.3: fast Phong takes no root per pixel. Instead m Newton steps take m divisions, and
/// J/d and 2JK/D take one each.
#[test]
fn fast_phong_trades_the_root_for_divisions() {
    for steps in 1..=8 {
        let counts = operations(&format!("fast-phong:steps={steps}"), 1);
        assert_eq!(counts.walk.roots + counts.shade.roots, 0);
        assert_eq!(counts.walk.divisions + counts.shade.divisions, steps + 2);
        assert_eq!(
            counts.span.roots, 1,
            "the first pixel of a span has a true root"
        );
    }
}

/// Duff 1979: the squared length of the normal takes two additions and no multiplication per pixel.
/// One root and one division remain.
#[test]
fn duff_phong_steps_by_additions_only() {
    for lights in [1, 4] {
        let counts = operations("duff-phong", lights);
        assert!(counts.walk == (lights as u32 + 3) * ADD);
        assert_eq!((counts.shade.roots, counts.shade.divisions), (1, 1));
    }
}

/// L21 4.4: "all the necessary sines and cosines incrementally with just four
/// additions/subtractions and eight multiplications. No trigonometric evaluations are necessary,
/// nor are any square roots required." The lecture counts the sines only. The weighted sums come on
/// top.
#[test]
fn slerp_steps_by_four_additions_and_eight_multiplications() {
    for lights in [1, 4] {
        let (scalar, vector) = (
            operations("slerp-phong", lights),
            operations("slerp-phong-vector", lights),
        );
        assert!(scalar.edge_step == rotation() && vector.edge_step == rotation());
        assert!(scalar.walk == rotation() + (lights as u32 + 1) * (2 * MULTIPLY + ADD));
        assert!(vector.walk == rotation() + weighted_normal());
        for counts in [scalar, vector] {
            let pixel = [counts.walk, counts.shade];
            assert!(
                pixel
                    .iter()
                    .all(|c| c.roots + c.divisions + c.trigonometric == 0)
            );
        }
    }
}

/// Four lights cost at most four times as much as one. Operations that do not involve lights cost
/// no more.
#[test]
fn cost_grows_with_the_lights() {
    let pixel = |entry: &'static MethodRow, lights| {
        let counts = entry.variant().operations(lights);
        counts.walk.multiplications + counts.shade.multiplications
    };
    for entry in floats() {
        let (one, four) = (pixel(entry, 1), pixel(entry, 4));
        assert!(
            // A method with several kinds may choose another loop for four lights.
            one <= four && (four <= 4 * one || !entry.kinds().is_empty()),
            "{}: {one}, {four}",
            entry.info.name
        );
    }
    assert!(
        floats()
            .iter()
            .any(|entry| pixel(entry, 4) > pixel(entry, 1)),
        "some method is lit at pixels"
    );
}
