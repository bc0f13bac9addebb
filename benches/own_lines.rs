//! Lines of a rasterizer outside the crate, with both vertices of each, in scalar code and with the
//! best instruction set. `fastphong bench --spans` times every method's spans without a rasterizer.

mod clock;

use clock::OwnTime;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fastphong::mesh::Material;
use fastphong::number::SimdLevel;
use fastphong::scene::{Interpolation, Light, Lighting};
use fastphong::shading::{SpanShader, SpanVertex, Variant};
use glam::DVec3;
use std::hint::black_box;
use std::time::Duration;

fn own_lines(c: &mut Criterion<OwnTime>) {
    let light = Light::directional(DVec3::new(0.3, 0.4, 0.9), [1.0; 3]);
    let lighting = Lighting::new(&Material::default(), [1.0; 3], &[light], DVec3::Z);
    for name in ["gouraud", "naive-phong", "phong-rsqrt", "fast-phong"] {
        let variant = Variant::parse(name).expect("a method");
        let mut group = c.benchmark_group(format!("own lines/{variant}"));
        for length in [16usize, 64, 512] {
            group.throughput(Throughput::Elements(length as u64));
            for level in [SimdLevel::Scalar, SimdLevel::best()] {
                let shader = SpanShader::new(&variant, &lighting, Interpolation::Screen);
                let mut shader = shader.expect("a method for any light").with_simd(level);
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
    config = clock::criterion(1)
        .sample_size(20)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500));
    targets = own_lines
}
criterion_main!(benches);
