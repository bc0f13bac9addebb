use fastphong::{mesh, scene::file::SceneFile, shader::Variant};
use std::sync::Arc;
fn main() {
    let spec = std::env::args().nth(1).unwrap();
    let m = std::env::args().nth(2).unwrap();
    let n: usize = std::env::args().nth(3).unwrap().parse().unwrap();
    let mut file = SceneFile::for_mesh(spec.clone());
    if let Some(w) = std::env::args().nth(4) {
        file.image.width = Some(w.parse::<i64>().unwrap().into());
        file.image.height = Some((w.parse::<i64>().unwrap() * 9 / 16).into());
    }
    let r = file
        .resolve(|s, _| {
            mesh::builtin::builtin(s.strip_prefix("builtin:").unwrap())
                .map(|m| (Arc::new(m), vec![]))
                .map_err(|e| e.to_string())
        })
        .map_err(|e| eprintln!("{e}"))
        .unwrap();
    let frame = r.scene.frame().unwrap();
    if n == 0 {
        for _ in 0..15 {
            let t = std::time::Instant::now();
            let f = r.scene.frame().unwrap();
            println!("frame {:?} {}", t.elapsed(), f.polygons().len());
        }
        return;
    }
    let v = Variant::parse(&m).unwrap();
    let mut p = v.render(&frame);
    let mut best = f64::MAX;
    let mut cov = 0;
    for _ in 0..n {
        let t = std::time::Instant::now();
        v.render_into(&frame, &mut p);
        best = best.min(t.elapsed().as_secs_f64());
        cov = p.texels().iter().filter(|t| t[3] == 255).count();
    }
    println!("{m} {:.3} ms {:.2} ns/px", best * 1e3, best * 1e9 / cov as f64);
}
