//! Naive Phong shading compiled outside the crate and inside it, with every engine and instruction
//! set. Both must be equally fast: crossing the crate's border must cost nothing per pixel.
//!
//! ```text
//! cargo bench --bench own_shader
//! ```

mod clock;
mod scenes;

use clock::OwnTime;
use criterion::{BenchmarkId, Criterion, SamplingMode, criterion_group, criterion_main};
use fastphong::number::{Num, Vec3};
use fastphong::picture::Picture;
use fastphong::raster::{DrawOptions, Renderer};
use fastphong::shading::{Info, LightAt, Linear, MethodRow, Needs, Normal, Shader, Span};
use std::hint::black_box;

/// A copy of `src/shading/methods/roots/naive_phong.rs`.
#[derive(Clone, Copy, Default)]
struct Outside;

impl Shader for Outside {
    const INFO: Info = Info {
        name: "outside",
        title: "naive Phong shading, compiled outside the crate",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        sums_lights: true,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = Linear<Vec3<F>>;

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        lit.shade(n.unit())
    }
}

static OUTSIDE: MethodRow = MethodRow::of::<Outside>();

fn own_shader(c: &mut Criterion<OwnTime>) {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .expect("no pool before");
    let inside = MethodRow::named("naive-phong").expect("a method of the table");
    for (name, mesh) in scenes::SCENES {
        let frame = scenes::scene(mesh).frame().expect("a valid scene");
        let mut group = c.benchmark_group(format!("own_shader/{name}"));
        group.sampling_mode(SamplingMode::Flat);
        for renderer in Renderer::available() {
            let pictures = [inside, &OUTSIDE].map(|entry| {
                let mut picture =
                    Picture::new(frame.picture_width(), frame.picture_height(), [0; 4]);
                let place = format!("{}-{}", renderer.engine().name(), renderer.level());
                let variant = entry.variant();
                group.bench_function(BenchmarkId::new(place, variant.info().name), |b| {
                    b.iter(|| {
                        variant.draw(black_box(&frame), &mut picture, DrawOptions::by(renderer))
                    });
                });
                picture
            });
            let [inside, outside] = &pictures;
            assert!(inside == outside, "one method draws one picture");
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = clock::criterion(1);
    targets = own_shader
}
criterion_main!(benches);
