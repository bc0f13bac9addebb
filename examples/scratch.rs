use fastphong::{image_file, mesh, metrics, raster, reference, scene::file::SceneFile, shader::METHODS};
use std::sync::Arc;
fn main() {
    let spec = std::env::args().nth(1).unwrap();
    let file = if spec.ends_with(".toml") {
        SceneFile::load(&spec).map_err(|e| eprintln!("{e}")).unwrap()
    } else {
        SceneFile::for_mesh(spec.clone())
    };
    let t = std::time::Instant::now();
    let r = file
        .resolve(|s, dir| {
            if let Some(b) = s.strip_prefix("builtin:") {
                mesh::builtin::builtin(b).map(|m| (Arc::new(m), vec![])).map_err(|e| e.to_string())
            } else {
                mesh::obj::load_obj(&dir.join(s)).map(|l| (Arc::new(l.mesh), l.warnings)).map_err(|e| e.to_string())
            }
        })
        .map_err(|e| eprintln!("{e}"))
        .unwrap();
    println!("resolve {:?} {:?}", t.elapsed(), r.warnings);
    let t = std::time::Instant::now();
    let frame = r.scene.frame().unwrap();
    println!("frame {:?} {:?} {} polys", t.elapsed(), frame.stats(), frame.polygons().len());
    let t = std::time::Instant::now();
    let vis = reference::visibility(&frame);
    println!("visibility {:?}", t.elapsed());
    let ids = raster::polygon_numbers(&frame);
    let refs: Vec<_> =
        [reference::Model::Flat, reference::Model::Gouraud, reference::Model::Phong, reference::Model::Slerp]
            .into_iter()
            .map(|m| (m, reference::shade(&frame, &vis, m)))
            .collect();
    println!("ref all {:?}", t.elapsed());
    for e in METHODS {
        let v = e.variant();
        let mut best = f64::MAX;
        let mut p = None;
        for _ in 0..7 {
            let t = std::time::Instant::now();
            p = Some(v.render(&frame));
            best = best.min(t.elapsed().as_secs_f64());
        }
        let p = p.unwrap();
        let lin = v.render_linear(&frame);
        let own = &refs.iter().find(|(m, _)| *m == e.info.model).unwrap().1;
        let wrong =
            (0..frame.width() * frame.height()).filter(|&i| own.polygons.texels()[i] != ids.texels()[i]).count();
        let d = metrics::compare_where(&own.to_linear(), &lin, |x, y| own.polygons.get(x, y) == ids.get(x, y)).unwrap();
        let cov = p.texels().iter().filter(|t| t[3] == 255).count();
        println!(
            "{:20} {:8.3} ms {:6.2} ns/px own max {:.2e} rms {:.2e} at {:?} otherpoly {wrong} cov {cov}",
            e.info.name,
            best * 1e3,
            best * 1e9 / cov as f64,
            d.max,
            d.rms,
            d.worst
        );
        image_file::write_file(
            std::path::Path::new(&format!("/tmp/out-{}.png", e.info.name)),
            &image_file::encode_png(&p).unwrap(),
        )
        .unwrap();
        if let Some(f) = None::<fn()> {
            f()
        }
        let mut bb = f64::MAX;
        for _ in 0..7 {
            let t = std::time::Instant::now();
            let b = v.render_barycentric(&frame, raster::Edges::TopLeft);
            if b.is_some() {
                bb = bb.min(t.elapsed().as_secs_f64());
            }
        }
        if bb < 1e9 {
            let b = v.render_barycentric(&frame, raster::Edges::TopLeft).unwrap();
            let d = metrics::compare(&b, &p).unwrap();
            println!(
                "   barycentric {:8.3} ms  diff max {:.4} cov mismatch {}",
                bb * 1e3,
                d.max,
                d.coverage_mismatches
            );
        }
    }
}
