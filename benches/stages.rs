//! Stages before and around shading: meshes, vertex normals, projection, coverage, triangulation.

mod clock;
mod scenes;

use clock::OwnTime;
use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use fastphong::frame::triangulate::triangulated;
use fastphong::mesh::builtin::builtin;
use fastphong::mesh::vertex_normals::{NormalSource, vertex_normals};
use fastphong::raster::{coverage, polygon_indices};
use glam::{DAffine3, DVec3};
use std::hint::black_box;
use std::time::Duration;

/// A crease angle in degrees that keeps the edges of a prism and smooths a sphere.
const CREASE: f64 = 30.0;

fn stages(c: &mut Criterion<OwnTime>) {
    for (name, mesh) in scenes::SCENES {
        let scene = scenes::scene(mesh);
        let shape = &scene.objects[0].mesh;
        let frame = scene.frame().expect("a valid scene");
        let mut group = c.benchmark_group(format!("stages/{name}"));
        group.sampling_mode(SamplingMode::Flat);
        group.throughput(Throughput::Elements(shape.polygon_count() as u64));
        group.bench_function("mesh", |b| b.iter(|| builtin(black_box(mesh))));
        let sources = [
            ("averaged", NormalSource::Averaged),
            ("given", NormalSource::Given),
            ("crease", NormalSource::Crease(CREASE)),
        ];
        for (source_name, source) in sources {
            group.bench_function(format!("normals/{source_name}"), |b| {
                b.iter(|| vertex_normals(black_box(shape), source));
            });
        }
        // Projection includes averaging the vertex normals.
        group.bench_function("projection", |b| b.iter(|| black_box(&scene).frame()));
        group.throughput(Throughput::Elements(frame.polygons().len() as u64));
        group.bench_function("triangulation", |b| {
            b.iter(|| triangulated(black_box(&frame)))
        });
        group.bench_function("coverage", |b| {
            b.iter(|| {
                let mut pixels = 0;
                coverage(black_box(&frame), |_, _, span| pixels += span.len());
                pixels
            });
        });
        group.bench_function("visibility", |b| {
            b.iter(|| polygon_indices(black_box(&frame)))
        });
        group.finish();
    }
}

/// Times the projection of scenes into frames. The meshes are triangles, and about half of them are
/// culled. RAYON_NUM_THREADS sets how many threads project.
fn projection(c: &mut Criterion<OwnTime>) {
    for (name, mesh) in scenes::TRIANGLES {
        let scene = scenes::scene(mesh);
        let shape = &scene.objects[0].mesh;
        let mut group = c.benchmark_group(format!("projection/{name}"));
        group.sampling_mode(SamplingMode::Flat);
        group.throughput(Throughput::Elements(shape.polygon_count() as u64));
        group.bench_function("frame", |b| b.iter(|| black_box(&scene).frame()));
        group.bench_function("prepare", |b| b.iter(|| black_box(&scene).prepare()));
        let mut prepared = scene.prepare().expect("a valid scene");
        let mut frame = prepared.frame().expect("a valid scene");
        group.bench_function("frame_into", |b| {
            b.iter(|| black_box(&prepared).frame_into(&mut frame))
        });
        prepared.set_camera(scenes::camera(shape, Some(45.0)));
        group.bench_function("frame_into/perspective", |b| {
            b.iter(|| black_box(&prepared).frame_into(&mut frame))
        });
        group.finish();
    }
}

/// Times a scene of 40 parts of which one spins, from its next transform to the frame: once by
/// moving it in a prepared scene, once by preparing the whole scene again.
fn moving(c: &mut Criterion<OwnTime>) {
    let mut scene = scenes::scene("sphere?polygons=5000&triangles=true");
    for part in 1..40 {
        let place = DVec3::new(f64::from(part % 8) - 3.5, f64::from(part / 8) - 2.0, 0.0);
        let mut object = scene.objects[0].clone();
        object.transform = DAffine3::from_translation(3.0 * place);
        scene.objects.push(object);
    }
    let still = scene.objects[7].transform;
    let mut spins = (0..).map(|step| still * DAffine3::from_rotation_y(0.01 * f64::from(step)));
    let mut spin = || spins.next().expect("a turn");
    let mut prepared = scene.prepare().expect("a valid scene");
    let mut frame = prepared.frame().expect("a valid scene");
    let mut group = c.benchmark_group("moving/one of 40");
    group.sampling_mode(SamplingMode::Flat);
    group.bench_function("set_transform", |b| {
        b.iter(|| prepared.set_transform(7, spin()))
    });
    group.bench_function("set_transform, frame_into", |b| {
        b.iter(|| {
            let moved = prepared.set_transform(7, spin());
            prepared.frame_into(&mut frame).and(moved)
        });
    });
    group.bench_function("frame_into", |b| b.iter(|| prepared.frame_into(&mut frame)));
    group.bench_function("prepare, frame_into", |b| {
        b.iter(|| {
            scene.objects[7].transform = spin();
            scene.prepare()?.frame_into(&mut frame)
        });
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = clock::criterion(rayon::current_num_threads())
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1500));
    targets = stages, projection, moving
}
criterion_main!(benches);
