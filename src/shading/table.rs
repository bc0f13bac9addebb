//! The method table: add a line here for a new file beside this one.

use super::adaptive_phong::AdaptivePhong;
use super::biquadratic_normals::BiquadraticNormals;
use super::bishop_weimer::{BishopWeimer, BishopWeimerLocal};
use super::count::{CountedSpan, count};
use super::cubic_phong::CubicPhong;
use super::difference_vector::DifferenceVector;
use super::duff_half::DuffHalf;
use super::duff_newton::DuffNewton;
use super::duff_phong::{DuffPhong, DuffPhongLocal};
use super::eye_frame_phong::EyeFramePhong;
use super::fast_phong::FastPhong;
use super::flat::Flat;
use super::flat_average::FLAT_AVERAGE;
use super::gouraud::Gouraud;
use super::gouraud_separate::GouraudSeparate;
use super::h_test::HTest;
use super::half_reflection::HalfReflection;
use super::integers::{self, Line};
use super::kuijk_blake::KuijkBlake;
use super::naive_phong::NaivePhong;
use super::phong_map::PhongMap;
use super::phong_rsqrt::PhongRsqrt;
use super::phong_unnormalised::PhongUnnormalised;
use super::quadratic_normals::QuadraticNormals;
use super::quaternion_phong::QuaternionPhong;
use super::series_phong::SeriesPhong;
use super::six_point::{SixPoint, SixPointLocal};
use super::slerp_chebyshev::SlerpChebyshev;
use super::slerp_half::SlerpHalf;
use super::slerp_phong::SlerpPhong;
use super::slerp_phong_vector::SlerpPhongVector;
use super::span_bench::SpanBench;
use super::stereographic_phong::StereographicPhong;
use super::{
    Extras, Fit, Info, Kernels, LitAt, Local, Method, Needs, On, Perspective, Variant,
    integer_fast, integer_fast_printed, integer_gouraud, integer_naive, integer_naive_printed,
    integer_quadratic, integer_slerp,
};
use crate::frame::Frame;

/// All shading methods.
pub static METHODS: &[Entry] = &TABLE;

/// The rows of [`METHODS`]. A static with a name: crates that name a method refer to it, where a constant without a name would
/// be copied into them, and all kernels compiled again.
static TABLE: [Entry; 38] = [
    Entry::of::<Flat>(),
    Entry {
        info: &FLAT_AVERAGE,
        needs: Needs {
            lit_at: LitAt::PolygonMean,
            ..Flat::NEEDS
        },
        ..Entry::of::<Flat>()
    },
    Entry::of::<Gouraud>(),
    Entry::of::<GouraudSeparate>(),
    Entry::of::<NaivePhong>(),
    Entry::by_lights::<FastPhong<1>, FastPhong<4>, FastPhong<8>, FastPhong<64>>(),
    Entry::by_lights::<
        DuffPhong<1, true>,
        DuffPhong<4, true>,
        DuffPhong<8, true>,
        DuffPhong<64, true>,
    >(),
    Entry::of::<PhongRsqrt>(),
    Entry::by_lights::<DuffPhong<1>, DuffPhong<4>, DuffPhong<8>, DuffPhong<64>>()
        .positional::<DuffPhongLocal<1>, DuffPhongLocal<4>, DuffPhongLocal<64>>(),
    Entry::by_lights::<DuffNewton<1>, DuffNewton<4>, DuffNewton<8>, DuffNewton<64>>(),
    Entry::by_lights::<SeriesPhong<1>, SeriesPhong<4>, SeriesPhong<8>, SeriesPhong<64>>(),
    Entry::by_lights::<CubicPhong<1>, CubicPhong<4>, CubicPhong<8>, CubicPhong<64>>(),
    Entry::by_lights::<
        DifferenceVector<1>,
        DifferenceVector<4>,
        DifferenceVector<8>,
        DifferenceVector<64>,
    >(),
    Entry::by_lights::<BishopWeimer<1>, BishopWeimer<4>, BishopWeimer<8>, BishopWeimer<64>>()
        .positional::<BishopWeimerLocal<1>, BishopWeimerLocal<4>, BishopWeimerLocal<64>>(),
    Entry::by_lights::<SixPoint<1>, SixPoint<4>, SixPoint<8>, SixPoint<64>>()
        .positional::<SixPointLocal<1>, SixPointLocal<4>, SixPointLocal<64>>(),
    Entry::of::<QuadraticNormals>(),
    Entry::of::<BiquadraticNormals>(),
    Entry::of::<HTest>(),
    Entry::of::<AdaptivePhong<true>>()
        .one_light::<AdaptivePhong<false>>()
        .positional::<PhongRsqrt, PhongRsqrt, PhongRsqrt>(),
    Entry::by_lights::<SlerpPhong<1>, SlerpPhong<4>, SlerpPhong<8>, SlerpPhong<64>>(),
    Entry::by_lights::<SlerpChebyshev<1>, SlerpChebyshev<4>, SlerpChebyshev<8>, SlerpChebyshev<64>>(
    ),
    Entry::of::<SlerpPhongVector>(),
    Entry::by_lights::<DuffHalf<1>, DuffHalf<4>, DuffHalf<8>, DuffHalf<64>>(),
    Entry::of::<EyeFramePhong>(),
    Entry::of::<PhongUnnormalised>(),
    Entry::by_lights::<SlerpHalf<1>, SlerpHalf<4>, SlerpHalf<8>, SlerpHalf<64>>(),
    Entry::of::<StereographicPhong>(),
    Entry::of::<QuaternionPhong>(),
    Entry::by_lights::<HalfReflection<1>, HalfReflection<4>, HalfReflection<8>, HalfReflection<64>>(
    ),
    Entry::of::<PhongMap>(),
    Entry::by_lights::<KuijkBlake<1>, KuijkBlake<4>, KuijkBlake<8>, KuijkBlake<64>>(),
    integer_gouraud::ENTRY,
    Entry::integer::<integer_naive::Naive>(),
    Entry::integer::<integer_fast::Fast>(),
    Entry::integer::<integer_quadratic::Parabolas>(),
    Entry::integer::<integer_slerp::Waves>(),
    Entry::integer::<integer_naive_printed::NaivePrinted>(),
    Entry::integer::<integer_fast_printed::FastPrinted>(),
];

/// Kernels for 1 light, up to 4, up to 8 and up to 64.
type ByLights = [&'static Kernels; 4];

/// Counts the operations of a method on a span.
type CountSpan = fn(&SpanBench, &Variant) -> CountedSpan;

/// A row of the method table: the description of a method, and its kernels.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The description of the method.
    pub info: &'static Info,
    /// What it needs of engines.
    pub needs: Needs,
    /// Says whether it draws a frame, or spans of a material: [`Shader::on`](super::Shader::on).
    pub(crate) fit: fn(On<'_>) -> Fit,
    /// True if its loops compute in integers, for processors without a floating-point unit.
    pub is_integer: bool,
    directional: ByLights,
    positional: ByLights,
    /// The functions that count operations, for one light and for more: without a light or the eye at a position, and with one.
    count: [[CountSpan; 2]; 2],
}

impl Entry {
    /// Makes the row of a method, also of one defined outside this crate.
    pub const fn of<M: Method>() -> Entry {
        Entry::by_lights::<M, M, M, M>()
    }

    /// Makes the row of a method by kernels of its own; what else engines ask is as `M` answers.
    pub(super) const fn of_kernels<M: Method>(
        info: &'static Info,
        kernels: &'static Kernels,
    ) -> Entry {
        Entry {
            info,
            directional: [kernels; 4],
            positional: [kernels; 4],
            ..Entry::of::<M>()
        }
    }

    /// Makes the row of a method in integers by its loop.
    pub(super) const fn integer<L: Line>() -> Entry {
        let kernels = const { &Kernels::of_functions::<L::Shell>(L::PIXELS, integers::WHY) };
        Entry::integer_of::<L::Shell>(&L::INFO, kernels, |bench, variant| {
            integers::counted::<L::Shell>(bench, variant, L::PIXELS, L::LIGHTS, |lights| {
                L::counts(lights, variant.parameters())
            })
        })
    }

    /// Makes the row of a method in integers: as [`Entry::of_kernels`], with a function that says what its loops take.
    pub(super) const fn integer_of<M: Method>(
        info: &'static Info,
        kernels: &'static Kernels,
        count: CountSpan,
    ) -> Entry {
        Entry {
            is_integer: true,
            count: [[count; 2]; 2],
            ..Entry::of_kernels::<M>(info, kernels)
        }
    }

    /// Makes the row of a method whose varyings hold a number per light: compiled for 1, 4, 8 and 64 of them.
    pub const fn by_lights<A: Method, B: Method, C: Method, D: Method>() -> Entry {
        let all: ByLights = const {
            [
                &Kernels::of::<A>(),
                &Kernels::of::<B>(),
                &Kernels::of::<C>(),
                &Kernels::of::<D>(),
            ]
        };
        Entry {
            info: &A::INFO,
            needs: A::NEEDS,
            fit: A::on,
            is_integer: false,
            directional: all,
            positional: all,
            // For up to eight lights as many are stepped, for up to 64 as many as there are: what is counted.
            count: [[count::<D>; 2]; 2],
        }
    }

    /// Takes other kernels for one light.
    pub(super) const fn one_light<A: Method>(self) -> Entry {
        let one = const { &Kernels::of::<A>() };
        let [[_, up_to_4, up_to_8, up_to_64], all] = [self.directional, self.positional];
        let [[_, counts_many], counts_positional] = self.count;
        Entry {
            directional: [one, up_to_4, up_to_8, up_to_64],
            positional: [one, all[1], all[2], all[3]],
            count: [
                [count::<A>, counts_many],
                [count::<A>, counts_positional[1]],
            ],
            ..self
        }
    }

    /// Takes other kernels where a light or the eye is at a position: for 1 light, for 4 and for 64.
    pub const fn positional<A: Method, B: Method, C: Method>(self) -> Entry {
        let [one, few, many] = const {
            [
                &Kernels::of::<A>(),
                &Kernels::of::<B>(),
                &Kernels::of::<C>(),
            ]
        };
        Entry {
            positional: [one, few, many, many],
            count: [self.count[0], [count::<C>; 2]],
            ..self
        }
    }

    /// Returns the row called `name`.
    pub fn named(name: &str) -> Option<&'static Entry> {
        METHODS.iter().find(|entry| entry.info.name == name)
    }

    /// Returns the row whose kernels draw a frame: its own, or the one that stands in for it there.
    pub(crate) fn on(&'static self, frame: &Frame) -> &'static Entry {
        match (self.fit)(On::Frame(frame)) {
            Fit::LeavesTo(name) => Entry::named(name).expect("a method stands in by its name"),
            _ => self,
        }
    }

    /// Returns the reason why it is drawn by scalar code only, if it is.
    pub fn scalar_only(&self) -> Option<&'static str> {
        self.directional[0].needs.scalar_only
    }

    /// Returns the names of the kinds of polygons that it tells apart: [`Method::Kinds`](super::Method::Kinds).
    pub fn kinds(&self) -> &'static [&'static str] {
        self.directional[0].kinds
    }

    /// True if a pixel depends only on the varyings there; the barycentric renderer draws only such methods.
    pub fn is_barycentric(&self) -> bool {
        self.directional[0].linear && !self.needs.reads_span()
    }

    /// Returns the varyings that kernels add to those of the method, under perspective or not, with a light or the eye at a
    /// position (`is_local`) or not.
    pub(crate) fn extras(&self, is_local: bool, perspective: bool) -> Extras {
        let point = is_local && self.needs.local == Local::PerPixel && self.positional[0].linear;
        let divides = self.needs.perspective == Perspective::Divides;
        Extras {
            point,
            weight: perspective && (divides || point),
        }
    }

    /// Counts the operations of a variant of the method on a span.
    pub(super) fn count(&self, bench: &SpanBench, variant: &Variant) -> CountedSpan {
        let by_lights = self.count[usize::from(bench.is_local())];
        by_lights[usize::from(bench.lighting.lights.len() > 1)](bench, variant)
    }

    /// Returns the kernels for so many lights, some at positions (`is_local`) or none.
    pub(crate) fn kernels(&self, lights: usize, is_local: bool) -> &'static Kernels {
        let all = if is_local {
            self.positional
        } else {
            self.directional
        };
        match lights {
            0 | 1 => all[0],
            2..=4 => all[1],
            5..=8 => all[2],
            _ => all[3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Normal, Shader};
    use super::*;
    use crate::number::{Level, Num, Vec3};
    use crate::shading::{Linear, Lit, Span};
    use std::collections::BTreeSet;

    /// Returns the functions in the tables of these methods, each once: AVX-512 takes those of AVX2 but for its shading.
    fn compiled(entries: &[Entry]) -> usize {
        let mut kernels = BTreeSet::new();
        for entry in entries {
            kernels.extend(
                entry
                    .count
                    .as_flattened()
                    .iter()
                    .map(|count| *count as usize),
            );
            for table in [entry.directional, entry.positional].as_flattened() {
                kernels.extend([table.vertices as usize, table.pixels as usize]);
                for simd in Level::ALL.into_iter().filter_map(table.simd) {
                    kernels.insert(simd.shade as usize);
                    kernels.extend(simd.vertices.map(|vertices| vertices as usize));
                    kernels.extend(simd.walk.map(|walk| walk as usize));
                }
            }
        }
        kernels.len()
    }

    /// Every kernel is compiled code, and all of it is compiled before anything is drawn: a method may cost no more than this.
    #[test]
    fn kernels_are_few() {
        let all = compiled(METHODS);
        std::println!("{all} kernels");
        assert!(all <= 6 * METHODS.len(), "{all} kernels");
        for entry in METHODS {
            let own = compiled(&[*entry]);
            let by_lights = !core::ptr::eq(entry.directional[0], entry.directional[3]);
            let most = if by_lights { 24 } else { 8 };
            let has_positional = !core::ptr::eq(entry.directional[0], entry.positional[0]);
            assert!(
                own <= most * (1 + usize::from(has_positional)),
                "{}: {own}",
                entry.info.name
            );
        }
    }

    /// Gouraud shading in integers of 1/65,536 of a level: plain functions in a row of the table.
    mod integers {
        use super::super::*;
        use crate::shading::kernels::Pixels;

        const INFO: Info = Info {
            name: "integer-gouraud",
            ..<Gouraud as Method>::INFO
        };
        static KERNELS: Kernels = Kernels::of_functions::<Gouraud>(pixels, "it is integers");
        pub static ENTRY: Entry = Entry::of_kernels::<Gouraud>(&INFO, &KERNELS);

        fn pixels(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
            const ONE: f32 = 255.0 * 65_536.0;
            let mut out = out.iter_mut();
            for (number, run) in job.list.runs.iter().enumerate() {
                let [at, step] = job.list.starts.of(number);
                let fixed = |x: &[f32]| [x[0], x[1], x[2]].map(|x| (x * ONE) as i32);
                let (mut at, step) = (fixed(at), fixed(step));
                for pixel in out.by_ref().take(run.pixels as usize) {
                    *pixel = at.map(|x| (x >> 16) as f32 * (1.0 / 255.0));
                    at = [0, 1, 2].map(|c| at[c] + step[c]);
                }
            }
        }
    }

    #[test]
    fn a_row_of_plain_functions_is_drawn() {
        use crate::mesh::builtin::builtin;
        use crate::raster::{Plan, Renderer};
        use crate::scene::Scene;
        let frame = Scene::of_mesh(builtin("sphere").unwrap()).frame().unwrap();
        let [integer, float] = [
            integers::ENTRY.variant(),
            Variant::parse("gouraud").unwrap(),
        ];
        let fastest = Renderer::fastest();
        if fastest != Renderer::Span {
            let (renderer, reason) = (Renderer::Span, "it is integers");
            assert_eq!(
                integer.plan(&frame, fastest),
                Plan::Instead { renderer, reason }
            );
        }
        let [ours, theirs] =
            [integer, float].map(|variant| variant.render(&frame).expect("a method for the frame"));
        let levels = ours.pixels().iter().zip(theirs.pixels());
        let most = levels
            .flat_map(|(a, b)| [0, 1, 2].map(|c| a[c].abs_diff(b[c])))
            .max();
        // Cut down, where the other is rounded; and a step's 1/65,536 a pixel.
        assert_eq!(most, Some(1));
    }

    /// Phong shading for frames of one light.
    #[derive(Clone, Copy, Default)]
    struct OneLight;

    impl Shader for OneLight {
        const INFO: Info = Info {
            name: "one-light",
            ..<NaivePhong as Shader>::INFO
        };
        type Constants<F: Num> = ();
        type Carries = Normal;
        type Walk<F: Num> = Linear<Vec3<F>>;

        fn on(on: On<'_>) -> Fit {
            on.each(|lighting, _| (lighting.lights.len() > 1).then_some("it knows one light"))
        }
        fn walk<F: Num>(self, _: &Lit<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
            span.linear()
        }
        fn shade<F: Num>(self, lit: &Lit<'_, F>, n: Vec3<F>) -> Vec3<F> {
            lit.shade(n.unit())
        }
    }

    static ONE_LIGHT: Entry = Entry::of::<OneLight>();

    #[test]
    fn a_method_may_refuse_a_frame() {
        use crate::mesh::builtin::builtin;
        use crate::picture::Picture8;
        use crate::raster::{DrawError, DrawOptions, Plan, Renderer};
        use crate::scene::{Light, Scene};
        let mut scene = Scene::of_mesh(builtin("sphere").unwrap());
        let plan = |scene: &Scene| {
            let frame = scene.frame().unwrap();
            ONE_LIGHT.variant().plan(&frame, Renderer::Span)
        };
        assert_eq!(plan(&scene), Plan::AsAsked(Renderer::Span));
        scene
            .lights
            .push(Light::directional(glam::DVec3::X, [1.0; 3]));
        let reason = "it knows one light";
        assert_eq!(plan(&scene), Plan::Refused(reason));
        let (frame, variant) = (scene.frame().unwrap(), ONE_LIGHT.variant());
        let mut picture = Picture8::new(frame.picture_width(), frame.picture_height(), [7; 4]);
        for renderer in Renderer::available() {
            let drawn = variant.draw(&frame, &mut picture, DrawOptions::by(renderer));
            assert_eq!(drawn, Err(DrawError::Refused(reason)));
            let rows = variant.render_rows(&frame, renderer, |_| Err("drawn"));
            assert_eq!(rows, Err(DrawError::Refused(reason)));
        }
        assert!(picture.pixels().iter().all(|pixel| *pixel == [7; 4]));
    }
}
