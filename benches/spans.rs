//! Single spans: the cost of a method's set-up and of each pixel.
//!
//! A span of n pixels takes set-up + n · slope. At n = 1 the time is nearly all set-up, which
//! here includes the material uniforms and two vertices per span. At n = 1024 the time per element
//! is nearly the slope. Methods that step scalars instead of vectors pay more set-up for a smaller
//! slope. The lines of two methods cross at their break-even length.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fastphong::mesh::Material;
use fastphong::number::SimdLevel;
use fastphong::scene::{Interpolation, Light, Lighting};
use fastphong::shading::SpanRow;
use fastphong::shading::{METHODS, SpanBench, SpanShader, SpanVertex, Variant};
use glam::DVec3;
use std::hint::black_box;
use std::time::Duration;

/// Angle between the normals at the ends of the span, in degrees, as on a coarse mesh.
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
        // Call the kernels of each instruction set as the row engine does, on the longest span,
        // with one light and with four.
        const LONG: usize = 1024;
        group.throughput(Throughput::Elements(LONG as u64));
        for level in SimdLevel::available().skip(1) {
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

/// Times lines of a rasterizer outside the crate, both vertices included, in scalar code and with
/// the best instruction set.
fn own_lines(c: &mut Criterion) {
    let light = Light::directional(DVec3::new(0.3, 0.4, 0.9), [1.0; 3]);
    let lighting = Lighting::new(&Material::default(), [1.0; 3], &[light], DVec3::Z);
    for name in ["gouraud", "naive-phong", "phong-rsqrt", "fast-phong"] {
        let variant = Variant::parse(name).expect("a method");
        let mut group = c.benchmark_group(format!("own lines/{variant}"));
        for length in [16usize, 64, 512] {
            group.throughput(Throughput::Elements(length as u64));
            for level in [SimdLevel::Scalar, SimdLevel::best()] {
                let mut shader = SpanShader::new(&variant, &lighting, Interpolation::Screen)
                    .expect("a method for any light")
                    .with_simd(level);
                let (mut colours, count) = (vec![[0.0; 3]; length], shader.varyings());
                let mut ends = vec![0.0; 2 * count];
                group.bench_function(BenchmarkId::new(level.to_string(), length), |b| {
                    b.iter(|| {
                        let (left, right) = ends.split_at_mut(count);
                        let normals = black_box([[-0.2, 0.0, 1.0], [0.2, 0.1, 1.0]]);
                        shader.vertex_into(SpanVertex::of_normal(normals[0]), left);
                        shader.vertex_into(SpanVertex::of_normal(normals[1]), right);
                        let ends = [(0.0, &*left), (length as f32, &*right)];
                        shader.shade(ends, [0, 0], black_box(&mut colours));
                    });
                });
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
    targets = spans, own_lines
}
criterion_main!(benches);
