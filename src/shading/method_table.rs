//! The method table: each method is a file below `methods/` and a line in [`METHODS`].

use crate::frame::Frame;
use crate::shading::kernels::operation_counts::{CountedSpan, count};
use crate::shading::kernels::sample_span::SpanBench;
#[cfg(feature = "io")]
use crate::shading::kernels::walked::Walked;
use crate::shading::methods::angles::half_reflection::HalfReflection;
use crate::shading::methods::angles::kuijk_blake::KuijkBlake;
use crate::shading::methods::angles::phong_map::PhongMap;
use crate::shading::methods::angles::quaternion_phong::QuaternionPhong;
use crate::shading::methods::angles::slerp_chebyshev::SlerpChebyshev;
use crate::shading::methods::angles::slerp_phong::SlerpPhong;
use crate::shading::methods::angles::slerp_phong_vector::SlerpPhongVector;
use crate::shading::methods::angles::stereographic_phong::StereographicPhong;
use crate::shading::methods::colours::flat::Flat;
use crate::shading::methods::colours::flat_average::FLAT_AVERAGE;
use crate::shading::methods::colours::gouraud::Gouraud;
use crate::shading::methods::colours::gouraud_separate::GouraudSeparate;
use crate::shading::methods::highlights::difference_vector::DifferenceVector;
use crate::shading::methods::highlights::duff_half::DuffHalf;
use crate::shading::methods::highlights::slerp_half::SlerpHalf;
use crate::shading::methods::hybrids::adaptive_phong::AdaptivePhong;
use crate::shading::methods::hybrids::h_test::HTest;
use crate::shading::methods::integers::{self, Line};
use crate::shading::methods::quadratics::biquadratic_normals::BiquadraticNormals;
use crate::shading::methods::quadratics::bishop_weimer::{BishopWeimer, BishopWeimerLocal};
use crate::shading::methods::quadratics::quadratic_normals::QuadraticNormals;
use crate::shading::methods::quadratics::six_point::{SixPoint, SixPointLocal};
use crate::shading::methods::roots::duff_newton::DuffNewton;
use crate::shading::methods::roots::duff_phong::{DuffPhong, DuffPhongLocal};
use crate::shading::methods::roots::eye_frame_phong::EyeFramePhong;
use crate::shading::methods::roots::fast_phong::FastPhong;
use crate::shading::methods::roots::naive_phong::NaivePhong;
use crate::shading::methods::roots::phong_rsqrt::PhongRsqrt;
use crate::shading::methods::roots::phong_unnormalised::PhongUnnormalised;
use crate::shading::methods::series::cubic_phong::CubicPhong;
use crate::shading::methods::series::series_phong::SeriesPhong;
use crate::shading::{
    Extras, Fit, Info, Kernels, Local, Method, Needs, On, Perspective, ShadingRate, Variant,
};

/// Makes the row of a method whose varyings hold one value per light.
macro_rules! lights {
    ($method:ident $(, $parameter:literal)?) => {
        MethodRow::by_lights::<$method<1 $(, $parameter)?>, $method<4 $(, $parameter)?>, $method<64 $(, $parameter)?>>()
    };
}

/// All shading methods.
pub static METHODS: &[MethodRow] = &TABLE;

/// The rows of [`METHODS`]. This is a static with a name, to which other crates refer. A constant
/// without a name would be copied into them, and every kernel compiled again.
static TABLE: [MethodRow; 38] = [
    MethodRow::of::<Flat>(),
    MethodRow {
        info: &FLAT_AVERAGE,
        needs: Needs {
            shading_rate: ShadingRate::PolygonMean,
            ..Flat::NEEDS
        },
        ..MethodRow::of::<Flat>()
    },
    MethodRow::of::<Gouraud>(),
    MethodRow::of::<GouraudSeparate>(),
    MethodRow::of::<NaivePhong>(),
    lights!(FastPhong),
    lights!(DuffPhong, true),
    MethodRow::of::<PhongRsqrt>(),
    lights!(DuffPhong).at_positions(lights!(DuffPhongLocal)),
    lights!(DuffNewton),
    lights!(SeriesPhong),
    lights!(CubicPhong),
    lights!(DifferenceVector),
    lights!(BishopWeimer).at_positions(lights!(BishopWeimerLocal)),
    lights!(SixPoint).at_positions(lights!(SixPointLocal)),
    MethodRow::of::<QuadraticNormals>(),
    MethodRow::of::<BiquadraticNormals>(),
    MethodRow::of::<HTest>(),
    MethodRow::of::<AdaptivePhong<true>>()
        .one_light::<AdaptivePhong<false>>()
        .at_positions(MethodRow::of::<PhongRsqrt>()),
    lights!(SlerpPhong),
    lights!(SlerpChebyshev),
    MethodRow::of::<SlerpPhongVector>(),
    lights!(DuffHalf),
    MethodRow::of::<EyeFramePhong>(),
    MethodRow::of::<PhongUnnormalised>(),
    lights!(SlerpHalf),
    MethodRow::of::<StereographicPhong>(),
    MethodRow::of::<QuaternionPhong>(),
    lights!(HalfReflection),
    MethodRow::of::<PhongMap>(),
    lights!(KuijkBlake),
    integers::gouraud::ENTRY,
    MethodRow::integer::<integers::naive::Naive>(),
    MethodRow::integer::<integers::fast::Fast>(),
    MethodRow::integer::<integers::quadratic::Parabolas>(),
    MethodRow::integer::<integers::slerp::Waves>(),
    MethodRow::integer::<integers::naive_printed::NaivePrinted>(),
    MethodRow::integer::<integers::fast_printed::FastPrinted>(),
];

/// The kernels for 1, up to 4 and up to 64 lights.
type ByLights = [&'static Kernels; 3];

/// Counts the operations of a method on a span.
type CountSpan = fn(&SpanBench, &Variant) -> CountedSpan;

/// A row of the method table: the description of a method, and its kernels.
#[derive(Clone, Copy, Debug)]
pub struct MethodRow {
    /// The description of the method.
    pub info: &'static Info,
    /// What the method needs from engines.
    pub needs: Needs,
    /// Decides if the method draws a frame, or spans of a material:
    /// [`Shader::on`](super::Shader::on).
    fit: fn(On<'_>) -> Fit,
    /// True if the method computes in integers, for processors without a floating-point unit.
    pub is_integer: bool,
    directional: ByLights,
    positional: ByLights,
    /// The functions that count operations, by `[is_local][has more than one light]`.
    count: [[CountSpan; 2]; 2],
    /// The walks of `directional` and `positional`, compiled for up to 64 lights.
    #[cfg(feature = "io")]
    pub(crate) walked: [Walked; 2],
}

impl MethodRow {
    /// Makes the row of a method, which may be defined outside this crate.
    pub const fn of<M: Method>() -> MethodRow {
        MethodRow::by_lights::<M, M, M>()
    }

    /// Makes the row of a method that has its own kernels and answers all other questions as `M`
    /// does.
    pub(crate) const fn of_kernels<M: Method>(
        info: &'static Info,
        kernels: &'static Kernels,
    ) -> MethodRow {
        MethodRow {
            info,
            directional: [kernels; 3],
            positional: [kernels; 3],
            #[cfg(feature = "io")]
            walked: [Walked::none::<M>(); 2],
            ..MethodRow::of::<M>()
        }
    }

    /// Makes the row of an integer method from its loop.
    pub(crate) const fn integer<L: Line>() -> MethodRow {
        let kernels = const { &Kernels::of_functions::<L::Shell>(L::PIXELS, integers::WHY) };
        MethodRow::integer_of::<L::Shell>(&L::INFO, kernels, |bench, variant| {
            integers::counted::<L::Shell>(bench, variant, L::PIXELS, L::LIGHTS, |lights| {
                L::counts(lights, variant.parameters())
            })
        })
    }

    /// Makes the row of an integer method as [`MethodRow::of_kernels`] does, with a function that
    /// lists what its loops cost.
    pub(crate) const fn integer_of<M: Method>(
        info: &'static Info,
        kernels: &'static Kernels,
        count: CountSpan,
    ) -> MethodRow {
        MethodRow {
            is_integer: true,
            count: [[count; 2]; 2],
            ..MethodRow::of_kernels::<M>(info, kernels)
        }
    }

    /// Makes the row of a method whose varyings hold one value per light, from three types compiled
    /// for 1, 4 and 64 lights.
    pub const fn by_lights<A: Method, B: Method, C: Method>() -> MethodRow {
        let all: ByLights = const {
            [
                &Kernels::of::<A>(),
                &Kernels::of::<B>(),
                &Kernels::of::<C>(),
            ]
        };
        MethodRow {
            info: &A::INFO,
            needs: A::NEEDS,
            fit: A::on,
            is_integer: false,
            directional: all,
            positional: all,
            // Up to four lights are always stepped as four, but up to 64 only as many as exist,
            // which is what is to be counted.
            count: [[count::<C>; 2]; 2],
            #[cfg(feature = "io")]
            walked: [Walked::of::<C>(); 2],
        }
    }

    /// Replaces the kernels for one light.
    pub(crate) const fn one_light<A: Method>(self) -> MethodRow {
        let one = const { &Kernels::of::<A>() };
        let ([_, few, many], [_, near_few, near_many]) = (self.directional, self.positional);
        let [[_, counts], [_, near_counts]] = self.count;
        MethodRow {
            directional: [one, few, many],
            positional: [one, near_few, near_many],
            count: [[count::<A>, counts], [count::<A>, near_counts]],
            ..self
        }
    }

    /// Uses the kernels of another row for frames where a light or the eye is at a position.
    pub const fn at_positions(self, near: MethodRow) -> MethodRow {
        MethodRow {
            positional: near.positional,
            count: [self.count[0], near.count[1]],
            #[cfg(feature = "io")]
            walked: [self.walked[0], near.walked[1]],
            ..self
        }
    }

    /// Returns the row of the method with this name.
    pub fn named(name: &str) -> Option<&'static MethodRow> {
        METHODS.iter().find(|row| row.info.name == name)
    }

    /// Returns the reason why the method does not draw a frame, or spans of a material; `None` if
    /// it does.
    pub(crate) fn refuses(&self, on: On<'_>) -> Option<&'static str> {
        let (lights, is_local) = match on {
            On::Frame(frame) => (frame.light_count(), frame.is_local()),
            On::Spans(lighting, _) => (lighting.lights.len(), lighting.is_local()),
        };
        if lights > self.kernels(lights, is_local).lights {
            return Some("it has values for fewer lights");
        }
        (self.fit)(on).refused()
    }

    /// Returns the row whose kernels draw a frame: this one, or the one to which it leaves the
    /// frame.
    pub(crate) fn on(&'static self, frame: &Frame) -> &'static MethodRow {
        match (self.fit)(On::Frame(frame)) {
            Fit::LeavesTo(name) => MethodRow::named(name).expect("a method stands in by its name"),
            _ => self,
        }
    }

    /// Returns the reason why only scalar code draws the method, or `None` if SIMD does too.
    pub fn scalar_only(&self) -> Option<&'static str> {
        self.directional[0].needs.scalar_only
    }

    /// Returns the names of the kinds of polygons that the method tells apart
    /// ([`Method::Kinds`](super::Method::Kinds)); empty if it shades all polygons in one way.
    pub fn kinds(&self) -> &'static [&'static str] {
        self.directional[0].kinds
    }

    /// True if a pixel depends only on the varyings there. The barycentric renderer draws only
    /// these methods.
    pub fn is_barycentric(&self) -> bool {
        self.directional[0].linear && !self.needs.reads_span()
    }

    /// Returns the varyings that kernels add to the method's own: in perspective or not, with
    /// lights or eye at positions (`is_local`) or not, with vertex colours that multiply the
    /// materials (`is_coloured`) or not.
    pub(crate) fn extras(&self, is_local: bool, perspective: bool, is_coloured: bool) -> Extras {
        let point = is_local && self.needs.local == Local::PerPixel && self.positional[0].linear;
        let albedo = is_coloured && self.needs.shading_rate == ShadingRate::Pixel;
        let divides = perspective && (point || self.needs.perspective == Perspective::Divides);
        Extras {
            point,
            albedo,
            weight: divides || albedo && perspective && self.needs.perspective.is_weighted(),
            divides,
        }
    }

    /// Counts the operations of a variant of the method on a span.
    pub(crate) fn count(&self, bench: &SpanBench, variant: &Variant) -> CountedSpan {
        let by_lights = self.count[usize::from(bench.is_local())];
        by_lights[usize::from(bench.lighting.lights.len() > 1)](bench, variant)
    }

    /// Returns the kernels for `lights` lights, where some are at positions (`is_local`) or none.
    pub(crate) fn kernels(&self, lights: usize, is_local: bool) -> &'static Kernels {
        let all = if is_local {
            self.positional
        } else {
            self.directional
        };
        match lights {
            0 | 1 => all[0],
            2..=4 => all[1],
            _ => all[2],
        }
    }

    /// Returns the kernels whose runs [`MethodRow::walked`] walks along: those for any count of
    /// lights.
    #[cfg(feature = "io")]
    pub(crate) fn walked_kernels(&self, is_local: bool) -> &'static Kernels {
        self.kernels(usize::MAX, is_local)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Normal, Shader};
    use super::*;
    use crate::number::{Num, SimdLevel, Vec3};
    use crate::shading::{LightAt, Linear, Span};
    use std::collections::BTreeSet;

    /// Counts the distinct functions in these rows. AVX-512 shares all functions but shading with
    /// AVX2.
    fn compiled(rows: &[MethodRow]) -> usize {
        let mut kernels = BTreeSet::new();
        for row in rows {
            kernels.extend(row.count.as_flattened().iter().map(|count| *count as usize));
            for table in [row.directional, row.positional].as_flattened() {
                kernels.extend([table.vertices as usize, table.pixels as usize]);
                for simd in SimdLevel::ALL.into_iter().filter_map(table.simd) {
                    kernels.insert(simd.shade as usize);
                    kernels.extend(simd.vertices.map(|vertices| vertices as usize));
                    kernels.extend(simd.walk.map(|walk| walk as usize));
                }
            }
        }
        kernels.len()
    }

    /// Every kernel is compiled before anything is drawn, so a method may have no more kernels than
    /// this.
    #[test]
    fn kernels_are_few() {
        let all = compiled(METHODS);
        std::println!("{all} kernels");
        assert!(all <= 6 * METHODS.len(), "{all} kernels");
        for row in METHODS {
            let own = compiled(&[*row]);
            let by_lights = !core::ptr::eq(row.directional[0], row.directional[2]);
            let most = if by_lights { 18 } else { 8 };
            let has_positional = !core::ptr::eq(row.directional[0], row.positional[0]);
            assert!(
                own <= most * (1 + usize::from(has_positional)),
                "{}: {own}",
                row.info.name
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
        pub static ENTRY: MethodRow = MethodRow::of_kernels::<Gouraud>(&INFO, &KERNELS);

        fn pixels(job: &Pixels<'_>, out: &mut [[f32; 3]]) {
            const ONE: f32 = 255.0 * 65_536.0;
            for (index, run) in job.list.runs.iter().enumerate() {
                let values = job.list.starts.of(index);
                let fixed = |k: usize| [0, 1, 2].map(|i| (values.of(i)[k] * ONE) as i32);
                let (mut at, step) = (fixed(0), fixed(1));
                for pixel in run.of(out) {
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
        // These colours are cut down where the others are rounded; and each step is off by up to
        // 1/65,536 per pixel.
        assert_eq!(most, Some(1));
    }

    /// Phong shading for frames with one light.
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
        fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
            span.linear()
        }
        fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
            lit.shade(n.unit())
        }
    }

    static ONE_LIGHT: MethodRow = MethodRow::of::<OneLight>();

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
