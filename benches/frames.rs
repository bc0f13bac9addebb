//! Whole pictures: every method with the scalar span engine, the fastest engine and, if possible,
//! the barycentric renderer.
//!
//! A time is from the projected frame to the stored picture, per covered pixel. This benchmark
//! shows if a change made the code faster. `fastphong bench` times such frames in interleaved
//! rounds: quote its figures, not these.

mod clock;
mod scenes;

use clock::OwnTime;
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use fastphong::frame::triangulate::triangulated;
use fastphong::picture::Picture;
use fastphong::raster::{DrawOptions, Edges, NO_POLYGON, Renderer, polygon_indices};
use fastphong::shading::{METHODS, Variant};
use std::hint::black_box;
use std::time::Duration;

fn frames(c: &mut Criterion<OwnTime>) {
    for (name, mesh) in scenes::SCENES {
        let frame = scenes::scene(mesh).frame().expect("a valid scene");
        let triangles = triangulated(&frame).frame;
        let covered = polygon_indices(&frame)
            .pixels()
            .iter()
            .filter(|number| **number != NO_POLYGON)
            .count();
        let mut group = c.benchmark_group(format!("frames/{name}"));
        group.throughput(Throughput::Elements(covered as u64));
        // Every sample makes an equal count of calls. A frame takes milliseconds, so growing counts
        // would take minutes.
        group.sampling_mode(SamplingMode::Flat);
        let is_for =
            |variant: &Variant| variant.plan(&frame, Renderer::LECTURE).renderer().is_some();
        let variants = METHODS.iter().map(|entry| entry.variant());
        for variant in variants.filter(is_for) {
            group.bench_function(BenchmarkId::new("scanline", &variant), |b| {
                b.iter(|| variant.render(black_box(&frame)));
            });
            let mut picture = Picture::new(frame.picture_width(), frame.picture_height(), [0; 4]);
            group.bench_function(BenchmarkId::new("fastest", &variant), |b| {
                b.iter(|| {
                    variant.draw(
                        black_box(&frame),
                        &mut picture,
                        DrawOptions::by(Renderer::fastest()),
                    )
                });
            });
            if variant.row().is_barycentric() {
                group.bench_function(BenchmarkId::new("barycentric", &variant), |b| {
                    b.iter(|| variant.render_barycentric(black_box(&triangles), Edges::TopLeft));
                });
            }
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = clock::criterion(rayon::current_num_threads())
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1));
    targets = frames
}
criterion_main!(benches);
