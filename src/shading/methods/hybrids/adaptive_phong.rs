//! Phong shading at the least cost within a stated error: each polygon uses the cheapest pixel loop
//! that keeps within it.

use crate::frame::Frame;
use crate::number::{Num, Real, Vec3, vec3};
use crate::reference::Model;
use crate::scene::{Lighting, SpecularGate};
use crate::shading::methods::hybrids::adaptive_plan::{self as plan, Followed};
use crate::shading::methods::roots::phong_rsqrt::PhongRsqrt;
use crate::shading::walks::values::{scaled, values};
use crate::shading::walks::{Quadratic, Walk};
use crate::shading::{
    Approximation, Chosen, Corners, Family, Fit, Info, LightAt, LightModel, Linear, Method,
    MethodParameter, Normal, On, OneOf, Pixel, Roundings, Shader, Span, Stepped, Tier, Value,
    Values,
};

/// Adaptive Phong shading. Each polygon uses the cheapest of five kinds of pixel loops whose error
/// is derived to be within `levels`. [`super::adaptive_plan`] has the derivation.
///
/// ```text
/// linear    I = a + r C                        C = (Σ k_d Lᵀ) N   of all lights in front, r a constant, or C = 0 and a the one colour
/// dull      I = a + C r                        r = k_0 + k_1 D by differences
/// curved    I = a + C r + Σ (J r, K r as in 4.5)     r = k_0 + D (k_1 + D k_2)
/// root      as curved,                         r = 1/√D
/// exact     as phong-rsqrt
/// ```
///
/// J = L·N is stepped only for lights whose highlight may be seen on the polygon, or whose J
/// changes its sign there: at most two. Without `MANY` there is at most one light, which all curved
/// polygons step, so that C is no help.
#[derive(Clone, Copy, Debug, Default)]
pub struct AdaptivePhong<const MANY: bool> {
    levels: f32,
}

/// The least mean length of a run, in pixels, for which planning pays. On shorter ones, set-up and
/// the span engine take most of the time. With one light there is less to save at a pixel, so runs
/// must be longer.
const LEAST_RUN_OF_ONE: f64 = 6.0;
const LEAST_RUN: f64 = 4.0;
/// How many polygons are examined to judge a frame.
const SAMPLES: usize = 256;

/// True if plans pay on a frame: lights and eye are at infinity, materials have one colour each,
/// some highlights are gated, and runs are not too short. Polygons spread over the whole list are a
/// sample.
fn is_worth_planning(frame: &Frame) -> bool {
    // Plans refuse the other gates: all their polygons would be drawn by `phong-rsqrt`.
    let is_gated = |lighting: &Lighting| lighting.gate == SpecularGate::Gated;
    if frame.is_local() || frame.is_coloured() || !frame.lightings().iter().any(is_gated) {
        return false;
    }
    let (width, height) = (frame.width() as f64, frame.height() as f64);
    let (mut area, mut rows) = (0.0, 0.0);
    let polygons = frame.polygons();
    for polygon in polygons.iter().step_by(polygons.len() / SAMPLES + 1) {
        let corners = frame.corners(polygon);
        let at = |k: usize| {
            let v = &frame.vertices()[corners[k % corners.len()] as usize];
            [v.x, v.y].map(|x| f64::from(x.to_bits()) / 256.0)
        };
        let doubled: f64 = (0..corners.len())
            .map(|k| (at(k), at(k + 1)))
            .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
            .sum();
        let ys = (0..corners.len()).map(|k| at(k)[1].clamp(0.0, height));
        let (low, high) = crate::shading::bounds::polygon_ranges::range(ys);
        area += f64::min(0.5 * doubled.abs(), width * (high - low));
        rows += high - low;
    }
    let least = match frame.light_count() {
        0 | 1 => LEAST_RUN_OF_ONE,
        _ => LEAST_RUN,
    };
    area > least * rows
}

/// Returns a vector in all lanes of a block like `zero`.
#[inline(always)]
fn all<F: Num>(zero: F, v: Vec3<F::One>) -> Vec3<F> {
    vec3([
        zero.of_each(|_| v.x),
        zero.of_each(|_| v.y),
        zero.of_each(|_| v.z),
    ])
}

/// True if D falls below a `share` of its greatest value along a run. D = q + 2 a k + g k² at pixel
/// k, and `end` at the `last` one. D is convex: it is greatest at an end, and least at an end or at
/// k = −a/g, where it is q − a²/g.
#[inline(always)]
fn is_uneven<F: Num>([q, a, g]: [F; 3], end: F, share: F, last: f32) -> bool {
    let is_over = |a: F, b: F| (a - b).any_over(0.0);
    let (of_start, of_end) = (share * q, share * end);
    let turns = (-a).any_over(0.0) && (a + g * last).any_over(0.0);
    // The minimum lies inside the run if D falls at its start and rises at its end.
    let bottom = q * g - a * a; // times g
    is_over(of_start, end)
        || is_over(of_end, q)
        || turns && (is_over(of_start * g, bottom) || is_over(of_end * g, bottom))
}

/// Returns the product of a matrix, as its rows, with a vector.
#[inline(always)]
fn times<F: Num>(rows: [Vec3<F>; 3], v: Vec3<F>) -> Vec3<F> {
    vec3([rows[0].dot(v), rows[1].dot(v), rows[2].dot(v)])
}

/// Returns how many lights a polygon can follow at most.
const fn most(many: bool) -> usize {
    if many { plan::MOST } else { 1 }
}

impl<const MANY: bool> Method for AdaptivePhong<MANY> {
    const INFO: Info = Info {
        name: "adaptive-phong",
        ids: &["M29"],
        family: Family::Hybrids,
        tier: Tier::Default,
        title: "for each polygon the cheapest of five pixel loops whose error is derived to be within a limit in grey levels",
        formula: "D = N.N >= 1 - s;  s = max |Ni - m|^2;  1/sqrt(D) ~ r, k0 + k1 D, k0 + k1 D + k2 D^2 or itself\n\
                  I = Ia ka + (sum Ip kd L^T) N r + Ip ks (2 (J r)(K r) - L.V)^n of lights whose highlight may be seen",
        source: "ours; differences as Duff 1979, polynomials for the root as Bishop, Weimer 1986",
        model: Model::Phong,
        parameters: &[MethodParameter::decimal(
            "levels",
            "largest error by design in grey levels of 255",
            0.5,
            [0.05, 16.0],
        )],
        roundings: Roundings::new(8.0, 2.0, Stepped::Products),
        derivation: "as the coarser of phong-rsqrt and duff-phong in each term; the error by design, levels/255 of a colour, is derived in \
                     the code, from corners only",
        approximation: |_, _, parameters| Approximation {
            colour: parameters[0].decimal().unwrap_or_default() / 255.0,
            ..Approximation::NONE
        },
        fails: "on polygons of few pixels, planning takes longer than it saves: there, and where lights or eye are at positions, phong-rsqrt draws \
                the frame",
        ..Info::OF_PIXELS
    };
    type Kinds = (
        PhongRsqrt,
        OneColour,
        Dull,
        Curved<MANY, false>,
        Curved<MANY, true>,
    );

    fn on(on: On<'_>) -> Fit {
        match on {
            On::Frame(frame) if !is_worth_planning(frame) => {
                Fit::LeavesTo(<PhongRsqrt as Shader>::INFO.name)
            }
            On::Spans(lighting, _) if lighting.vertex_colours => {
                Fit::Refuses("its plans hold one colour per material, and no vertex colours")
            }
            _ => Fit::Draws,
        }
    }
    #[inline(always)]
    fn new(parameters: &[Value], _: &LightModel) -> Self {
        AdaptivePhong {
            levels: parameters[0].decimal().unwrap_or_default() as f32,
        }
    }
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let plan = plan::plan(self.levels, !MANY, lit, polygon);
        let zero = lit.zero();
        let mut rows = [vec3([zero; 3]); 3];
        let mut base = lit.ambient();
        if plan.is_one_colour {
            let sum = |sum: Vec3<R>, n: &Vec3<R>| sum + *n;
            let first = polygon.whole[0];
            base = lit.shade(polygon.whole[1..].iter().fold(first, sum).unit());
        } else if plan.kind != plan::EXACT {
            for light in lit.lights().filter(|l| plan.in_front >> l.index & 1 == 1) {
                let colour = light.diffuse().broadcast(zero);
                for (row, channel) in rows.iter_mut().zip(colour.array()) {
                    *row = *row + light.to * channel;
                }
            }
            if plan.kind == plan::LINEAR {
                rows = rows.map(|row| row * zero.broadcast(plan.factors[0]));
            }
        }
        let factors = vec3(plan.factors).broadcast(zero);
        let value = |value: f32| zero.broadcast(value);
        let followed = plan.followed.map(|one| {
            let parts = [one.diffuse, one.highlight].map(|part| value(f32::from(u8::from(part))));
            (value(one.light.into()), (parts[0], parts[1]))
        });
        match plan.kind {
            plan::EXACT => OneOf::First(()),
            plan::LINEAR => OneOf::Second((rows, base)),
            plan::DULL => OneOf::Third((rows, [factors.x, factors.y])),
            plan::CURVED => OneOf::Fourth((rows, factors, followed)),
            _ => OneOf::Fifth((rows, factors, followed)),
        }
    }
}

/// Returns the walk of C N along a run, from the rows of C.
#[inline(always)]
fn colours<F: Num>(
    zero: F,
    rows: [Vec3<F::One>; 3],
    Linear { at, step }: Linear<Vec3<F>>,
) -> Linear<Vec3<F>> {
    let rows = rows.map(|row| all(zero, row));
    Linear {
        at: times(rows, at),
        step: times(rows, step),
    }
}

/// The kind of polygons whose colour is linear in the normal: a + r C.
#[derive(Clone, Copy, Debug, Default)]
pub struct OneColour;

impl Shader for OneColour {
    const INFO: Info = Info::of_kind("linear");
    type Constants<F: Num> = ([Vec3<F>; 3], Vec3<F>); // r C by rows; a
    type Carries = Normal;
    type Walk<F: Num> = Linear<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["Ir", "Ig", "Ib"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let (rows, base) = span.constants();
        let Linear { at, step } = colours(lit.zero(), rows, span.linear());
        Linear {
            at: all(lit.zero(), base) + at,
            step,
        }
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, colour: Vec3<F>) -> Vec3<F> {
        colour
    }
}

/// The kind of polygons without highlights: a + C r, with r a line in D.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dull;

impl Shader for Dull {
    const INFO: Info = Info::of_kind("dull");
    type Constants<F: Num> = ([Vec3<F>; 3], [F; 2]); // C by rows; the line
    type Carries = Normal;
    type Walk<F: Num> = (Linear<Vec3<F>>, Quadratic<F>);
    const VALUES: &'static [&'static str] = &["Cr", "Cg", "Cb", "r"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let (rows, factors) = span.constants();
        let [k0, k1] = factors.map(|k| lit.zero().of_each(|_| k));
        let normal = span.linear();
        let (n, dn) = (normal.at, normal.step);
        let along = n.dot(dn);
        let r = Quadratic::new(k0 + k1 * n.dot(n), k1 * (along + along), k1 * dn.dot(dn));
        (colours(lit.zero(), rows, normal), r)
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (colour, r): Pixel<Self, F>) -> Vec3<F> {
        lit.ambient() + colour * r
    }
}

/// The kind of polygons with highlights: C r, and J r and K r of the followed lights, with r a
/// parabola of D, or 1/√D with `ROOT`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Curved<const MANY: bool, const ROOT: bool>;

impl<const MANY: bool, const ROOT: bool> Shader for Curved<MANY, ROOT> {
    const INFO: Info = Info::of_kind(if ROOT { "root" } else { "curved" });
    // C by rows; the factors; the followed lights, each as its index and the parts that are
    // followed.
    type Constants<F: Num> = ([Vec3<F>; 3], Vec3<F>, [(F, (F, F)); plan::MOST]);
    type Carries = Normal;
    type Walk<F: Num> = CurvedWalk<F, MANY>;
    const VALUES: &'static [&'static str] =
        &["J_a", "J_b", "K", "Cr", "Cg", "Cb", "D", "k0", "k1", "k2"];

    #[inline(always)]
    fn walk<F: Num>(self, lit: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let (rows, factors, followed) = span.constants();
        let (normal, zero) = (span.linear(), lit.zero());
        let (n, dn) = (normal.at, normal.step);
        let factors = all(zero, factors);
        let view = lit.view();
        let mut at = ([zero; plan::MOST], n.dot(view));
        let mut step = ([zero; plan::MOST], dn.dot(view));
        let mut lights = [Followed::default(); plan::MOST];
        for (i, (light, (diffuse, highlight))) in followed.into_iter().enumerate().take(most(MANY))
        {
            let (diffuse, highlight) = (diffuse.value() > 0.0, highlight.value() > 0.0);
            if diffuse || highlight {
                lights[i] = Followed {
                    light: light.value() as u16,
                    diffuse,
                    highlight,
                };
                let to = lit.seen(light.value() as usize).to;
                (at.0[i], step.0[i]) = (n.dot(to), dn.dot(to));
            }
        }
        let (square, along, growth) = (n.dot(n), n.dot(dn), dn.dot(dn));
        let mut every = plan::STEPS;
        if ROOT {
            let last = (span.pixels() - 1) as f32;
            let end = square + (along + along + growth * last) * last;
            if is_uneven([square, along, growth], end, factors.x, last) {
                every = 1;
            }
        }
        CurvedWalk {
            colour: if MANY {
                colours(zero, rows, normal)
            } else {
                normal // not stepped
            },
            products: Linear { at, step },
            square: Quadratic::new(square, along + along, growth),
            normal,
            first: at,
            factors,
            followed: lights,
            passed: 0,
            left: every,
            every,
        }
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, pixel: Pixel<Self, F>) -> Vec3<F> {
        let CurvedPixel {
            j, k, d, factors, ..
        } = pixel;
        let r = if ROOT {
            d.broadcast(1.0) / d.sqrt()
        } else {
            factors.x + d * (factors.y + d * factors.z)
        };
        let mut colour = lit.ambient();
        if MANY {
            colour = colour + pixel.colour * r;
        }
        let v_n = k * r;
        for (followed, j) in pixel.followed.0.into_iter().zip(j).take(most(MANY)) {
            // The branches here go the same way along the whole run.
            if MANY && !(followed.diffuse || followed.highlight) {
                continue;
            }
            let light = lit.seen(if MANY { followed.light.into() } else { 0 });
            let l_n = j * r;
            let diffuse = l_n.max(0.0);
            if !MANY || followed.diffuse {
                colour = lit.add_diffuse(colour, &light, diffuse);
            }
            if followed.highlight {
                let cosine = lit.highlight(&light, l_n, v_n);
                colour = lit.add_highlight(colour, &light, diffuse, cosine);
            }
        }
        colour
    }
}

/// The lights that a run follows. Each pixel has the list, but no value of it is stepped, so it has
/// no place in the G-buffer.
#[derive(Clone, Copy, Debug, Default)]
pub struct FollowedLights([Followed; plan::MOST]);

impl<F: Num> Values<F> for FollowedLights {
    #[inline(always)]
    fn filled(_: usize, _: F) -> Self {
        FollowedLights::default()
    }
    #[inline(always)]
    fn each(&mut self, _: &mut usize, _: &mut impl FnMut(usize, &mut F)) {}
    #[inline(always)]
    fn zip(&mut self, _: Self, _: impl Fn(F, F) -> F + Copy) {}
}

/// A pixel of a curved polygon.
#[derive(Clone, Copy, Debug)]
pub struct CurvedPixel<F> {
    /// J of each followed light, and K.
    j: [F; plan::MOST],
    k: F,
    /// The colour of the lights in front, times |N|.
    colour: Vec3<F>,
    /// D, and the factors of the parabola for 1/√D.
    d: F,
    factors: Vec3<F>,
    followed: FollowedLights,
}

values!([] CurvedPixel<F>, { j: [F; plan::MOST], k: F, colour: Vec3<F>, d: F, factors: Vec3<F>, followed: FollowedLights },
    |j, k, colour, d, factors, followed| CurvedPixel { j, k, colour, d, factors, followed });

type Products<F> = ([F; plan::MOST], F); // J of each followed light, K

/// The walk of a curved polygon along a run.
#[derive(Clone, Copy, Debug)]
pub struct CurvedWalk<F, const MANY: bool> {
    /// C N, the colour of the lights in front times |N|.
    colour: Linear<Vec3<F>>,
    products: Linear<Products<F>>,
    /// D.
    square: Quadratic<F>,
    /// N along the run, and the products at its first pixel.
    normal: Linear<Vec3<F>>,
    first: Products<F>,
    factors: Vec3<F>,
    followed: [Followed; plan::MOST],
    /// How many pixels lie before the last start, are left until the next one, and lie between two
    /// starts.
    passed: u32,
    left: u32,
    every: u32,
}

impl<F: Num, const MANY: bool> CurvedWalk<F, MANY> {
    /// Restarts differences and products, which drops the roundings of all steps before.
    #[inline(always)]
    fn restart(&mut self) {
        self.passed += self.every;
        self.left = self.every;
        let k = self.passed as f32;
        let Linear { at, step } = self.normal;
        self.square = Quadratic::square(at + step * k, step);
        let step = scaled(self.products.step, self.factors.x.broadcast(k));
        self.products.at = self.first;
        self.products.at.zip(step, |first, step| first + step);
    }
}

impl<F: Num, const MANY: bool> Walk<F> for CurvedWalk<F, MANY> {
    type Pixel = CurvedPixel<F>;

    #[inline(always)]
    fn next(&mut self) -> Self::Pixel {
        // Sums gather roundings, so they are restarted every `every` pixels, before these exceed
        // the plan's share.
        if self.left == 0 {
            self.restart();
        }
        self.left -= 1;
        // Only a start for the array: the places of followed lights are overwritten, no other is
        // read.
        let (mut j, k) = (self.first.0, self.products.at.1);
        self.products.at.1 = self.products.at.1 + self.products.step.1;
        let products = &mut self.products;
        for (i, j) in j.iter_mut().enumerate().take(most(MANY)) {
            *j = products.at.0[i];
            products.at.0[i] = products.at.0[i] + products.step.0[i];
        }
        let vector = if MANY {
            self.colour.next()
        } else {
            self.colour.at
        };
        let d = self.square.next();
        CurvedPixel {
            j,
            k,
            colour: vector,
            d,
            factors: self.factors,
            followed: FollowedLights(self.followed),
        }
    }
}
