//! Whole frames from a prepared scene to the stored picture, on one thread: the scalar span engine,
//! and the row engine on every instruction set of this machine.
//!
//! The floor is a lower bound: it clears, tests and writes every pixel once. The scene of few
//! triangles is also timed at 1920 × 1080. Scenes with four lights and with a million triangles are
//! timed with the span engine and the fastest engine.

mod clock;
mod scenes;

use clock::OwnTime;
use criterion::{BenchmarkId, Criterion, SamplingMode, criterion_group, criterion_main};
use fastphong::picture::Picture;
use fastphong::raster::{DrawOptions, Renderer};
use fastphong::shading::Variant;
use std::hint::black_box;
use std::time::Duration;

/// The methods to compare, including those that use the hardware's reciprocal root.
const METHODS: [&str; 5] = [
    "gouraud",
    "naive-phong",
    "fast-phong",
    "fast-phong-rsqrt",
    "phong-rsqrt",
];

/// How many scanlines a band of the floor has.
const BAND: usize = 32;

fn engines(c: &mut Criterion<OwnTime>) {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .use_current_thread()
        .build_global()
        .expect("no pool before");
    for (name, mesh) in scenes::SCENES {
        let prepared = scenes::scene(mesh).prepare().expect("a valid scene");
        let mut frame = prepared.frame().expect("a valid view");
        let mut group = c.benchmark_group(format!("engines/{name}"));
        // Every sample makes an equal count of calls. A frame takes milliseconds, so growing counts
        // would take minutes.
        group.sampling_mode(SamplingMode::Flat);
        let mut picture = Picture::new(frame.picture_width(), frame.picture_height(), [0; 4]);
        group.bench_function("projection", |b| {
            b.iter(|| prepared.frame_into(black_box(&mut frame)))
        });
        group.bench_function("floor", |b| {
            let mut depth = vec![0.0f32; picture.width() * BAND];
            b.iter(|| floor(black_box(&mut depth), picture.pixels_mut()));
        });
        for method in METHODS {
            let variant = Variant::parse(method).expect("a method of the table");
            for renderer in Renderer::available() {
                let name = format!("{}-{}", renderer.engine().name(), renderer.level());
                group.bench_function(BenchmarkId::new(name, method), |b| {
                    b.iter(|| {
                        variant.draw(black_box(&frame), &mut picture, DrawOptions::by(renderer))
                    });
                });
            }
        }
        group.finish();
    }
}

/// Times scenes with four lights and with a million triangles, with the scalar span engine and the
/// fastest engine.
fn large(c: &mut Criterion<OwnTime>) {
    for &(name, mesh, lights) in scenes::LARGE {
        let prepared = scenes::lit(mesh, lights).prepare().expect("a valid scene");
        let frame = prepared.frame().expect("a valid view");
        let mut group = c.benchmark_group(format!("engines/{name}"));
        group.sampling_mode(SamplingMode::Flat);
        let mut picture = Picture::new(frame.picture_width(), frame.picture_height(), [0; 4]);
        for method in METHODS {
            let variant = Variant::parse(method).expect("a method of the table");
            for (renderer, kind) in [
                (Renderer::LECTURE, "lecture"),
                (Renderer::fastest(), "fastest"),
            ] {
                group.bench_function(BenchmarkId::new(kind, method), |b| {
                    b.iter(|| {
                        variant.draw(black_box(&frame), &mut picture, DrawOptions::by(renderer))
                    });
                });
            }
        }
        group.finish();
    }
}

/// Times a 1920 × 1080 frame of few triangles, including projection, next to the floor.
fn over_floor(c: &mut Criterion<OwnTime>) {
    let (name, mesh) = scenes::SCENES[0];
    let mut scene = scenes::scene(mesh);
    (scene.width, scene.height) = (1920, 1080);
    let prepared = scene.prepare().expect("a valid scene");
    let mut frame = prepared.frame().expect("a valid view");
    let mut picture = Picture::new(frame.picture_width(), frame.picture_height(), [0; 4]);
    let mut group = c.benchmark_group(format!("engines/{name}-1920x1080"));
    group.sampling_mode(SamplingMode::Flat);
    group.bench_function("floor", |b| {
        let mut depth = vec![0.0f32; picture.width() * BAND];
        b.iter(|| floor(black_box(&mut depth), picture.pixels_mut()));
    });
    for method in ["gouraud", "naive-phong", "phong-rsqrt"] {
        let variant = Variant::parse(method).expect("a method of the table");
        group.bench_function(BenchmarkId::new("fastest", method), |b| {
            b.iter(|| {
                prepared
                    .frame_into(black_box(&mut frame))
                    .expect("a valid view");
                variant
                    .draw(&frame, &mut picture, DrawOptions::by(Renderer::fastest()))
                    .expect("a picture of the frame's size");
            });
        });
    }
    group.finish();
}

/// Clears depth and colour, then tests depth and writes both for every pixel, band by band.
fn floor(depth: &mut [f32], pixels: &mut [[u8; 4]]) {
    for band in pixels.chunks_mut(depth.len()) {
        depth.fill(f32::INFINITY);
        band.fill([0; 4]);
        let near = black_box(0.5);
        for (z, pixel) in depth.iter_mut().zip(band) {
            let is_nearer = near < *z;
            *z = if is_nearer { near } else { *z };
            *pixel = if is_nearer { [1, 2, 3, 255] } else { *pixel };
        }
    }
}

criterion_group! {
    name = benches;
    config = clock::criterion(1)
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600));
    targets = engines, large, over_floor
}
criterion_main!(benches);
