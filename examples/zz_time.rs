use fastphong::number::Level;
use fastphong::picture::Picture;
use fastphong::raster::{Engine, Renderer};
use fastphong::shader::Variant;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let scene = fastphong::input::resolve(&fastphong::input::load(&args[1]).unwrap()).unwrap();
    let frame = scene.scene.frame().unwrap();
    let threads: usize = args[2].parse().unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    for name in args[3].split(',') {
        let v = Variant::parse(name).unwrap();
        let reference = v.render(&frame);
        for level in Level::available() {
            for engine in Engine::ALL {
                let r = Renderer { engine: Some(engine), level };
                let mut p = Picture::new(1, 1, [0u8; 4]);
                let mut times = Vec::new();
                for _ in 0..15 {
                    let t = Instant::now();
                    pool.install(|| v.render_with(&frame, r, &mut p));
                    times.push(t.elapsed().as_secs_f64() * 1e3);
                }
                times.sort_by(f64::total_cmp);
                let mut max = 0;
                let mut cov = 0;
                let mut over = 0;
                for (a, b) in reference.texels().iter().zip(p.texels()) {
                    cov += usize::from(a[3] != b[3]);
                    let d = (0..3).map(|c| a[c].abs_diff(b[c])).max().unwrap();
                    over += usize::from(d > 1);
                    max = max.max(d);
                }
                println!(
                    "{name:18} {level:8} {engine:5} median {:.3} min {:.3} ms; max diff {max}, over 1: {over}, coverage {cov}",
                    times[7], times[0]
                );
            }
        }
        let t = Instant::now();
        let mut p = v.render(&frame);
        for _ in 0..3 {
            v.render_into(&frame, &mut p);
        }
        println!("{name:18} scalar lecture {:.3}", t.elapsed().as_secs_f64() * 250.0);
    }
}
