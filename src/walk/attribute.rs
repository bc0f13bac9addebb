//! What is walked along edges: affine values by a constant step, unit normals along great circles.

use super::Sines;
use crate::number::{Machine, Planes, Real, dot, each};
use core::convert::Infallible;

/// A value at a corner, and how it varies along an edge and between two edges.
///
/// `t0` and `dt` are the parameter at the first scanline (pixel) centre and its step; `face` is the unit normal of the
/// polygon, for values that need a way out where interpolation is undefined.
pub trait Attribute<R: Real>: Copy + Send + Sync {
    /// Running state along an edge.
    type Edge: Copy;
    /// What a span shader starts from.
    type Span: Copy;

    /// Starts the walk from `a` (upper end) to `b` (lower end).
    fn edge<M: Machine<One = R>>(m: M, face: [R; 3], a: Self, b: Self, t0: R, dt: R) -> Self::Edge;
    /// The value here.
    fn at(edge: &Self::Edge) -> Self;
    /// To the next scanline.
    fn advance(edge: &mut Self::Edge);
    /// Starts a span from `left` to `right`.
    fn span<M: Machine<One = R>>(
        m: M,
        face: [R; 3],
        left: Self,
        right: Self,
        t0: R,
        dt: R,
    ) -> Self::Span;
    /// Times the weight of perspective interpolation; attributes that cannot be weighted stay as they are.
    fn weighted(self, inv_w: R) -> Self;
    /// What is the same at all pixels of a triangle: see [`Attribute::plane`].
    type Plane: Copy;
    /// Whether it is linear over triangles.
    const IS_PLANAR: bool;

    /// The attribute over a triangle, where it is linear there: `across` is how much the barycentric coordinates of the
    /// second and the third corner grow from pixel to pixel. `None` where it is not linear.
    fn plane(corners: [Self; 3], across: [R; 2]) -> Option<Self::Plane>;
    /// A span that starts where the second and the third corner have the barycentric coordinates `w`.
    fn on_row(plane: &Self::Plane, w: [R; 2]) -> Self::Span;
    /// The same span as if it had begun `pixels` pixels earlier; one that has a single pixel (`is_one`) grows no more. `None` where
    /// it is not linear.
    ///
    /// A walk from there is off by at most 7 / 2 times the roundings of the span itself, where groups have eight pixels: over
    /// two pixels or more a value grows in each step by at most its whole range. Great circles are not: their recurrences
    /// would go on from sines that are several times as large as those inside.
    fn earlier(span: &Self::Span, pixels: R, is_one: bool) -> Option<Self::Span>;
    /// Its numbers, in order; none where it is not linear.
    fn numbers(self, to: &mut impl FnMut(R));
    /// A span of one pixel at barycentric coordinates `w`, for the barycentric renderer.
    fn barycentric<M: Machine<One = R>>(m: M, w: [R; 3], corners: [Self; 3]) -> Self::Span;
}

/// Values that can be added and scaled: numbers, arrays and tuples of them.
pub trait Affine<R: Real>: Planes<R> + Send + Sync {
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The difference.
    fn minus(self, other: Self) -> Self;
    /// The multiple.
    fn times(self, factor: R) -> Self;
    /// The multiple and a summand.
    #[inline(always)]
    fn times_plus(self, factor: R, summand: Self) -> Self {
        self.times(factor).plus(summand)
    }
}

impl<R: Real> Affine<R> for R {
    #[inline(always)]
    fn plus(self, other: R) -> R {
        self + other
    }
    #[inline(always)]
    fn minus(self, other: R) -> R {
        self - other
    }
    #[inline(always)]
    fn times(self, factor: R) -> R {
        self * factor
    }
}

impl<R: Real, const L: usize> Affine<R> for [R; L] {
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        each(|i| self[i] + other[i])
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        each(|i| self[i] - other[i])
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        each(|i| self[i] * factor)
    }
}

impl<R: Real> Affine<R> for () {
    #[inline(always)]
    fn plus(self, _: ()) {}
    #[inline(always)]
    fn minus(self, _: ()) {}
    #[inline(always)]
    fn times(self, _: R) {}
}

impl<R: Real, A: Affine<R>, B: Affine<R>> Affine<R> for (A, B) {
    #[inline(always)]
    fn plus(self, o: Self) -> Self {
        (self.0.plus(o.0), self.1.plus(o.1))
    }
    #[inline(always)]
    fn minus(self, o: Self) -> Self {
        (self.0.minus(o.0), self.1.minus(o.1))
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        (self.0.times(factor), self.1.times(factor))
    }
}

impl<R: Real, A: Affine<R>, B: Affine<R>, C: Affine<R>> Affine<R> for (A, B, C) {
    #[inline(always)]
    fn plus(self, o: Self) -> Self {
        (self.0.plus(o.0), self.1.plus(o.1), self.2.plus(o.2))
    }
    #[inline(always)]
    fn minus(self, o: Self) -> Self {
        (self.0.minus(o.0), self.1.minus(o.1), self.2.minus(o.2))
    }
    #[inline(always)]
    fn times(self, factor: R) -> Self {
        (
            self.0.times(factor),
            self.1.times(factor),
            self.2.times(factor),
        )
    }
}

/// An affine value here, and by how much it grows in a step.
#[derive(Clone, Copy, Debug)]
pub struct Ramp<A> {
    /// The value here.
    pub at: A,
    /// Its growth in a step.
    pub step: A,
}

/// An affine value over a triangle: the one at its first corner, how far the others are from it, and its growth from pixel
/// to pixel.
///
/// ```text
/// A = A_a + β (A_b − A_a) + γ (A_c − A_a)
/// ```
/// β and γ come from exact integers and are in 0..=1 inside, so that nothing cancels, however thin the triangle is.
#[derive(Clone, Copy, Debug)]
pub struct Facet<A> {
    origin: A,
    to_b: A,
    to_c: A,
    step: A,
}

/// An attribute that is interpolated linearly.
///
/// ```text
/// ΔI = (I_2 − I_1) / (y_2 − y_1)  along edges,   ΔI = (I_2 − I_1) / (x_2 − x_1)  along scan lines      (L21 3.5, 4.1)
/// I_next = I_current + ΔI                                                                              (L21 3.6, 4.2)
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Lerp<A>(pub A);

#[inline(always)]
fn ramp<R: Real, A: Affine<R>>(a: A, b: A, t0: R, dt: R) -> Ramp<A> {
    let difference = b.minus(a);
    Ramp {
        at: a.plus(difference.times(t0)),
        step: difference.times(dt),
    } // 3.5, 4.1
}

impl<R: Real, A: Affine<R>> Attribute<R> for Lerp<A> {
    type Edge = Ramp<A>;
    type Span = Ramp<A>;
    type Plane = Facet<A>;
    const IS_PLANAR: bool = true;

    #[inline(always)]
    fn edge<M: Machine<One = R>>(_: M, _: [R; 3], a: Self, b: Self, t0: R, dt: R) -> Ramp<A> {
        ramp(a.0, b.0, t0, dt)
    }
    #[inline(always)]
    fn at(edge: &Ramp<A>) -> Self {
        Lerp(edge.at)
    }
    #[inline(always)]
    fn advance(edge: &mut Ramp<A>) {
        edge.at = edge.at.plus(edge.step); // 3.6, 4.2
    }
    #[inline(always)]
    fn span<M: Machine<One = R>>(
        _: M,
        _: [R; 3],
        left: Self,
        right: Self,
        t0: R,
        dt: R,
    ) -> Ramp<A> {
        ramp(left.0, right.0, t0, dt)
    }
    #[inline(always)]
    fn weighted(self, inv_w: R) -> Self {
        Lerp(self.0.times(inv_w))
    }
    #[inline(always)]
    fn plane([a, b, c]: [Self; 3], [db, dc]: [R; 2]) -> Option<Facet<A>> {
        let (to_b, to_c) = (b.0.minus(a.0), c.0.minus(a.0));
        Some(Facet {
            origin: a.0,
            to_b,
            to_c,
            step: to_c.times_plus(dc, to_b.times(db)),
        })
    }
    #[inline(always)]
    fn on_row(facet: &Facet<A>, [b, c]: [R; 2]) -> Ramp<A> {
        let at = facet
            .to_c
            .times_plus(c, facet.to_b.times_plus(b, facet.origin));
        Ramp {
            at,
            step: facet.step,
        }
    }
    #[inline(always)]
    fn earlier(&Ramp { at, step }: &Ramp<A>, pixels: R, is_one: bool) -> Option<Ramp<A>> {
        Some(match is_one {
            true => Ramp {
                at,
                step: at.minus(at),
            },
            false => Ramp {
                at: at.minus(step.times(pixels)),
                step,
            },
        })
    }
    #[inline(always)]
    fn numbers(self, to: &mut impl FnMut(R)) {
        self.0.put(to);
    }
    #[inline(always)]
    fn barycentric<M: Machine<One = R>>(m: M, w: [R; 3], corners: [Self; 3]) -> Ramp<A> {
        let [a, b, c] = corners;
        let at = a.0.times(w[0]).plus(b.0.times(w[1])).plus(c.0.times(w[2]));
        Ramp {
            at,
            step: at.times(m.one(0.0)),
        }
    }
}

/// A unit normal: interpolated along the great circle, at uniform speed (L21 4.7).
#[derive(Clone, Copy, Debug)]
pub struct UnitNormal<R>(pub [R; 3]);

/// The great circle from one unit normal to another, ready for the weights of [`Sines`].
///
/// ```text
/// N(t) = sin((1−t)φ) / sin φ · N_1 + sin(tφ) / sin φ · N_2,      cos φ = N_1 · N_2      (L21 4.7, 4.8)
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Arc<R> {
    /// N_1 / sin φ.
    pub from: [R; 3],
    /// N_2 / sin φ.
    pub to: [R; 3],
    /// The angle φ between them, in radians.
    pub phi: R,
    /// The parameter at the first pixel centre.
    pub t0: R,
    /// Its step from pixel to pixel.
    pub dt: R,
}

impl<R: Real> Arc<R> {
    /// Below this angle, in radians, the circle is replaced by its chord: the weights are those of this angle, which
    /// differ from linear ones by less than φ²/16, 6·10⁻⁸, about half a unit in the last place of an `f32`.
    pub const SMALLEST_ANGLE: f32 = 1e-3;
    /// Beyond this angle (179°) the great circle is not defined by its ends: the face normal takes its place.
    pub const LARGEST_ANGLE: f32 = 179.0 * core::f32::consts::PI / 180.0;

    #[inline(always)]
    fn new<M: Machine<One = R>>(m: M, face: [R; 3], a: [R; 3], b: [R; 3], t0: R, dt: R) -> Self {
        let (sum, difference): ([R; 3], [R; 3]) = (a.plus(b), b.minus(a));
        let (cos_half, sin_half) = (dot(sum, sum).sqrt(), dot(difference, difference).sqrt());
        // φ = cos⁻¹(N_1 · N_2) as printed loses half of its digits near 0 and near π; the half-angle form does not.
        let half = sin_half.atan2(cos_half);
        let phi = half + half; // φ
        let (a, b, phi, sin_phi) = if phi.value() > Self::LARGEST_ANGLE {
            let phi = m.one(Self::SMALLEST_ANGLE);
            (face, face, phi, phi)
        } else if phi.value() < Self::SMALLEST_ANGLE {
            let phi = m.one(Self::SMALLEST_ANGLE);
            (a, b, phi, phi)
        } else {
            // sin φ = 2 sin(φ/2) cos(φ/2), and |b − a| = 2 sin(φ/2), |a + b| = 2 cos(φ/2) for unit vectors.
            (a, b, phi, m.one(0.5) * sin_half * cos_half) // sin φ
        };
        let scale = m.one(1.0) / sin_phi;
        Arc {
            from: a.times(scale),
            to: b.times(scale),
            phi,
            t0,
            dt,
        } // 4.7
    }
}

/// A great circle on its way down an edge.
#[derive(Clone, Copy, Debug)]
pub struct ArcWalk<R> {
    from: [R; 3],
    to: [R; 3],
    sines: Sines<R>,
}

impl<R: Real> Attribute<R> for UnitNormal<R> {
    type Edge = ArcWalk<R>;
    type Span = Arc<R>;
    type Plane = Infallible;
    const IS_PLANAR: bool = false;

    #[inline(always)]
    fn edge<M: Machine<One = R>>(m: M, face: [R; 3], a: Self, b: Self, t0: R, dt: R) -> ArcWalk<R> {
        let arc = Arc::new(m, face, a.0, b.0, t0, dt);
        ArcWalk {
            from: arc.from,
            to: arc.to,
            sines: Sines::new(SetUp(m), arc.phi, t0, dt),
        }
    }
    #[inline(always)]
    fn at(edge: &ArcWalk<R>) -> Self {
        let (s_from, s_to) = edge.sines.weights();
        UnitNormal(edge.from.times(s_from).plus(edge.to.times(s_to))) // 4.8
    }
    #[inline(always)]
    fn advance(edge: &mut ArcWalk<R>) {
        edge.sines.step(); // 4.9–4.12
    }
    #[inline(always)]
    fn span<M: Machine<One = R>>(
        m: M,
        face: [R; 3],
        left: Self,
        right: Self,
        t0: R,
        dt: R,
    ) -> Arc<R> {
        Arc::new(m, face, left.0, right.0, t0, dt)
    }
    #[inline(always)]
    fn weighted(self, _: R) -> Self {
        // The increments of a great circle are constant on the screen only: slerp stays screen-linear.
        self
    }
    #[inline(always)]
    fn plane(_: [Self; 3], _: [R; 2]) -> Option<Infallible> {
        None // great circles through three corners make no plane
    }
    #[inline(always)]
    fn on_row(plane: &Infallible, _: [R; 2]) -> Arc<R> {
        match *plane {}
    }
    #[inline(always)]
    fn earlier(_: &Arc<R>, _: R, _: bool) -> Option<Arc<R>> {
        None
    }
    #[inline(always)]
    fn numbers(self, _: &mut impl FnMut(R)) {}
    #[inline(always)]
    fn barycentric<M: Machine<One = R>>(m: M, w: [R; 3], corners: [Self; 3]) -> Arc<R> {
        let [a, b, c] = corners;
        let sum: [R; 3] = a.0.times(w[0]).plus(b.0.times(w[1])).plus(c.0.times(w[2]));
        let unit = sum.times(m.one(1.0) / dot(sum, sum).sqrt());
        Arc::new(m, unit, unit, unit, m.one(0.0), m.one(0.0))
    }
}

/// The set-up of a machine as a machine of its own: walks along edges run on `One`, one scanline at a time.
#[derive(Clone, Copy)]
struct SetUp<M>(M);

impl<M: Machine> Machine for SetUp<M> {
    type One = M::One;
    type F = M::One;
    const WIDTH: usize = 1;

    #[inline(always)]
    fn one(self, x: f32) -> M::One {
        self.0.one(x)
    }
    #[inline(always)]
    fn splat(self, x: M::One) -> M::One {
        x
    }
    #[inline(always)]
    fn ramp(self, at: M::One, _: M::One) -> M::One {
        at
    }
    #[inline(always)]
    fn stride(self, step: M::One) -> M::One {
        step
    }
    #[inline(always)]
    fn take(self, mut next: impl FnMut() -> M::One) -> M::One {
        next()
    }
    #[inline(always)]
    fn first(self, x: M::One) -> f32 {
        x.value()
    }
}
