//! One span at a time: the cost of a method's set-up, and of each pixel.
//!
//! The time of a span of n pixels is set-up + n · slope. At n = 1 it is nearly all set-up (constants of the material and
//! two vertices are part of it here, once a span); at n = 1024 the time per element is nearly the slope. Methods that
//! step scalars instead of vectors pay more set-up for a smaller slope; their lines cross at the length from which that pays.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fastphong::compare::timing::SpanRow;
use fastphong::number::Level;
use fastphong::shading::{METHODS, SpanBench};
use std::hint::black_box;
use std::time::Duration;

/// The angle between the normals at the ends of the span, in degrees: that of a coarse mesh.
const DEGREES: f32 = 20.0;
const LIGHTS: usize = 1;

fn spans(c: &mut Criterion) {
    let (bench, four) = (SpanBench::new(DEGREES, LIGHTS), SpanBench::new(DEGREES, 4));
    for variant in METHODS.iter().map(|entry| entry.variant()) {
        let mut group = c.benchmark_group(format!("spans/{variant}"));
        for length in (0..=10).map(|power| 1usize << power) {
            let mut out = vec![[0.0; 3]; length];
            group.throughput(Throughput::Elements(length as u64));
            group.bench_function(BenchmarkId::from_parameter(length), |b| {
                b.iter(|| variant.shade_span(black_box(&bench), black_box(&mut out)));
            });
        }
        // The kernels of the instruction sets on the longest span, one light and four: as the row engine calls them.
        const LONG: usize = 1024;
        group.throughput(Throughput::Elements(LONG as u64));
        for level in Level::available().skip(1) {
            for (lights, bench) in [(1, &bench), (4, &four)] {
                let mut row = SpanRow::new(&variant, bench, LONG);
                group.bench_function(
                    BenchmarkId::new(format!("{level}/{lights} lights"), LONG),
                    |b| {
                        b.iter(|| {
                            variant.shade_span_on(level, black_box(bench), black_box(&mut row));
                        });
                    },
                );
            }
        }
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500));
    targets = spans
}
criterion_main!(benches);
