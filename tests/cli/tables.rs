//! `fastphong list`, `explain`, `info` and help.

use super::Folder;
use fastphong::compare::metrics::METRICS;
use fastphong::mesh::builtin::BUILTINS;
use fastphong::number::SimdLevel;
use fastphong::raster::Engine;
use fastphong::scene::input::SCENES;
use fastphong::shading::{Family, METHODS, MethodRow, Tier};
use fastphong_cli::lectures::FIGURES;

#[test]
fn lists_have_an_entry_for_everything_in_their_table() {
    let folder = Folder::new();
    let names = |of: &str| -> Vec<String> {
        match of {
            "methods" => METHODS
                .iter()
                .map(|entry| entry.info.name.to_owned())
                .collect(),
            "meshes" => BUILTINS.iter().map(|shape| shape.name.to_owned()).collect(),
            "figures" => FIGURES
                .iter()
                .map(|figure| figure.name.to_owned())
                .collect(),
            "engines" => ["span", "row", "barycentric", "cs171"]
                .map(str::to_owned)
                .to_vec(),
            "simd" => SimdLevel::ALL.map(|level| level.name().to_owned()).to_vec(),
            "scenes" => SCENES.iter().map(|scene| scene.name.to_owned()).collect(),
            _ => METRICS
                .iter()
                .map(|metric| metric.name.to_owned())
                .collect(),
        }
    };
    for subject in [
        "methods", "meshes", "scenes", "metrics", "figures", "engines", "simd",
    ] {
        let text = folder.run(&format!("list {subject} --all")).done().out;
        let json = folder
            .run(&format!("list {subject} --all --json"))
            .done()
            .json();
        let entries = json.as_array().expect("a list");
        assert_eq!(
            entries
                .iter()
                .map(|entry| entry["name"].as_str().unwrap().to_owned())
                .collect::<Vec<_>>(),
            names(subject)
        );
        for name in names(subject) {
            let heading = if subject == "meshes" {
                format!("builtin:{name}")
            } else {
                name
            };
            assert!(
                text.lines()
                    .any(|line| line.split_whitespace().next() == Some(&heading)),
                "{heading}: {text}"
            );
        }
    }
    let meshes = folder.run("list meshes").done().out;
    let json = folder.run("list meshes --json").done().json();
    for (shape, entry) in BUILTINS.iter().zip(json.as_array().expect("a list")) {
        let parameters = entry["parameters"]
            .as_array()
            .expect("a list")
            .iter()
            .map(|p| p["name"].as_str().unwrap());
        assert!(
            parameters.eq(shape.all_parameters().map(|p| p.name)),
            "{entry}"
        );
        assert!(
            shape.all_parameters().all(|p| meshes.contains(p.doc)),
            "{meshes}"
        );
    }
    folder
        .run("list methods")
        .done()
        .prints("steps=auto or 1..8, default auto")
        .prints("perspective-correct at no cost");
    folder
        .run("list shaders")
        .refused(&["methods, meshes, scenes, metrics, figures, engines, simd"]);
}

#[test]
fn engines_and_instruction_sets_are_listed_with_their_abilities() {
    let folder = Folder::new();
    let listed = folder.run("list engines --json").done().json();
    let engines = listed.as_array().expect("a list");
    for (engine, entry) in [Engine::Span, Engine::Row].iter().zip(engines) {
        assert_eq!(entry["name"], engine.name());
    }
    for entry in METHODS {
        let explained = folder
            .run(&format!("explain {}", entry.info.name))
            .done()
            .out;
        for engine in engines {
            let name = engine["name"].as_str().expect("a name");
            let has = engine["methods"]
                .as_array()
                .expect("a list")
                .iter()
                .any(|method| *method == entry.info.name);
            let after = explained
                .split("\nengines\n")
                .nth(1)
                .expect("a section")
                .lines()
                .next()
                .expect("a line");
            assert_eq!(
                after.trim().split(", ").any(|other| other == name),
                has,
                "{name}: {after}"
            );
        }
    }
    let levels = folder.run("list simd --json").done().json();
    let text = folder.run("list simd").done().out;
    for ((level, entry), line) in SimdLevel::ALL
        .iter()
        .zip(levels.as_array().expect("a list"))
        .zip(text.lines())
    {
        let (here, auto) = (level.is_available(), *level == SimdLevel::best());
        assert_eq!(
            (&entry["available"], &entry["auto"]),
            (&here.into(), &auto.into()),
            "{entry}"
        );
        assert_eq!(
            (&entry["width"], &entry["title"]),
            (&level.width().into(), &level.title().into())
        );
        assert_eq!(
            (
                line.contains("not on this machine"),
                line.contains("chosen by auto")
            ),
            (!here, auto),
            "{line}"
        );
    }
}

/// Without `--all`, about ten methods are listed, with the count of the others.
#[test]
fn default_methods_are_listed_first() {
    let folder = Folder::new();
    let few = METHODS
        .iter()
        .filter(|method| method.info.tier == Tier::Default);
    let names: Vec<_> = few.map(|method| method.info.name).collect();
    assert!((8..=12).contains(&names.len()), "{names:?}");
    let listed = folder.run("list methods --json").done().json();
    let entries = listed.as_array().unwrap().iter();
    assert!(entries.map(|entry| &entry["name"]).eq(&names));
    let others = METHODS.len() - names.len();
    folder
        .run("list methods")
        .done()
        .prints(&format!("\n{others} more: fastphong list methods --all"));
}

/// Every family has members, and no method has the name of a family.
#[test]
fn families_are_not_methods() {
    for family in Family::ALL {
        assert!(METHODS.iter().any(|m| m.info.family == family));
    }
    let words = ["default", "all", "floats", "integers", "exhibits"];
    for word in words.into_iter().chain(Family::ALL.map(Family::name)) {
        assert!(MethodRow::named(word).is_none(), "{word}");
    }
}

#[test]
fn every_method_is_explained() {
    let folder = Folder::new();
    for entry in METHODS {
        let name = entry.info.name;
        let short = folder.run(&format!("explain {name}")).done();
        assert!(short.out.contains("with 1 light,") && !short.out.contains("with 4 lights"));
        let ended = folder
            .run(&format!("explain {name} --all"))
            .done()
            .prints(entry.info.title)
            .prints("pixel: shade")
            .prints("with 4 lights");
        for heading in [
            "formula",
            "source",
            "tolerance",
            "where it fails",
            "perspective",
            "engines",
            "parameters",
        ] {
            assert!(
                ended.out.lines().any(|line| line == heading),
                "{heading}: {}",
                ended.out
            );
        }
        let json = folder.run(&format!("explain {name} --json")).done().json();
        for lights in [1, 4] {
            let counted = entry.variant().operations(lights).shade.multiplications;
            assert_eq!(
                json["operations_by_lights"][lights.to_string()]["pixel_shade"]["mul"],
                counted,
                "{name}"
            );
        }
        assert_eq!(json["formula"], entry.info.formula);
        assert_eq!(
            json["roundings"]["step"].as_f64(),
            Some(entry.info.roundings.step)
        );
    }
    // One Newton step less saves one division per pixel.
    let divisions = |variant: &str| {
        let json = folder
            .run(&format!("explain {variant} --json"))
            .done()
            .json();
        json["operations_by_lights"]["1"]["pixel_walk"]["div"]
            .as_i64()
            .expect("a count")
    };
    assert_eq!(
        divisions("fast-phong:steps=2") - divisions("fast-phong:steps=1"),
        1
    );
    // The automatic choice has no value and is written as `auto`.
    let auto = folder
        .run("explain fast-phong:steps=auto --json")
        .done()
        .json();
    assert_eq!(
        (
            &auto["variant"],
            &auto["values"][0],
            &auto["parameters"][0]["default"]
        ),
        (&"fast-phong".into(), &"auto".into(), &"auto".into())
    );
    folder
        .run("explain fast-phong")
        .done()
        .prints("steps=auto: steps of Newton's method per pixel; auto or 1..8, default auto")
        .prints("auto: the fewest Newton steps");
    // With positional lights Duff's method takes two additions for each of its six products and for
    // the perspective weight.
    for (lights, additions) in [("1", 14), ("2", 20)] {
        let json = folder.run("explain duff-phong --json").done().json();
        let walk = &json["operations_by_lights_at_positions"][lights]["pixel_walk"];
        assert_eq!(
            (&walk["add"], &walk["mul"]),
            (&additions.into(), &0.into()),
            "{lights} lights"
        );
    }
    folder
        .run("explain duff-phong --all")
        .done()
        .prints("operations with 2 lights and eye at positions, as counted");
    folder
        .run("explain fast-fong")
        .refused(&["did you mean `fast-phong`?"]);
}

#[test]
fn info_counts_parts_of_a_mesh() {
    let folder = Folder::new();
    let of = |input: &str| {
        folder.run(&format!("info {input} --json")).done().json()["objects"][0].clone()
    };
    let cube = of("builtin:cube");
    assert_eq!(cube["polygons_by_sides"], serde_json::json!({ "4": 6 }));
    assert_eq!(
        (&cube["vertices"], &cube["edges"], &cube["closed"]),
        (&8.into(), &12.into(), &true.into())
    );
    assert_eq!(
        cube["bounds"],
        serde_json::json!([[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]])
    );
    assert_eq!(
        (&cube["concave"], &cube["not_planar"], &cube["degenerate"]),
        (&0.into(), &0.into(), &0.into())
    );
    let gear = of("builtin:gear?teeth=12");
    assert_eq!(
        (&gear["polygons_by_sides"]["48"], &gear["concave"]),
        (&2.into(), &2.into())
    );
    let star = of("builtin:star");
    assert_eq!(
        (&star["concave"], &star["open_edges"], &star["closed"]),
        (&1.into(), &10.into(), &false.into())
    );
    let football = of("football");
    assert_eq!(
        football["polygons_by_sides"],
        serde_json::json!({ "5": 12, "6": 20 })
    );
    assert_eq!(
        (&football["materials"], &football["given_normals"]),
        (&2.into(), &false.into())
    );
    assert_eq!(football["normals"], "averaged");

    // A bent quad, a triangle without area, two triangles of opposite winding, and a third one at
    // their common edge.
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0.5\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 6 -1 0\nv 5 0 1\n\
               v 0 2 0\nf 1 2 3 4\nf 1 4 10\nf 5 6 7\nf 5 6 8\n";
    folder.write("odd.obj", obj);
    let odd = of("odd.obj");
    assert_eq!(
        (&odd["not_planar"], &odd["degenerate"], &odd["concave"]),
        (&1.into(), &1.into(), &0.into())
    );
    assert_eq!(
        (&odd["reversed_edges"], &odd["non_manifold_edges"]),
        (&1.into(), &0.into())
    );
    folder.write("odd.obj", format!("{obj}f 6 5 9\n"));
    let odd = of("odd.obj");
    assert_eq!(
        (
            &odd["reversed_edges"],
            &odd["non_manifold_edges"],
            &odd["vertices"]
        ),
        (&0.into(), &1.into(), &10.into())
    );
}

#[test]
fn info_describes_scenes_too() {
    let folder = Folder::new();
    let ended = folder.run("info perspective --view 0,20").done();
    ended
        .prints("perspective: ")
        .prints("lights   2")
        .prints("objects  2")
        .prints("builtin:sphere?segments=16&rings=10");
    let json = folder.run("info perspective --json").done().json();
    assert_eq!(
        (&json["camera"]["fovy"], &json["camera"]["half_height"]),
        (&75.0.into(), &serde_json::Value::Null)
    );
    assert_eq!(
        (&json["lights"], &json["schema"]),
        (&2.into(), &"fastphong.info/1".into())
    );
    folder
        .run("info football")
        .done()
        .prints("averaged up to a crease of 10 degrees")
        .prints("12 of 5 sides, 20 of 6 sides");
}

/// `info` reports the choice of `auto`: the row engine on the best instruction set, or the span
/// engine with a reason.
#[test]
fn info_reports_the_choice_of_auto() {
    let folder = Folder::new();
    let best = SimdLevel::best();
    // Leave out methods in integers and others that cannot draw every frame.
    let choices = |input: &str| {
        let mut all = folder.run(&format!("info {input} --json")).done().json()["auto"].clone();
        let all = all.as_array_mut().unwrap();
        for choice in &mut *all {
            // h-test supports no positional lights.
            choice["methods"].as_array_mut().unwrap().retain(|name| {
                let name = name.as_str().unwrap();
                name != "h-test" && !MethodRow::named(name).unwrap().is_integer
            });
        }
        all.retain(|choice| choice["methods"][0].is_string() && !choice["engine"].is_null());
        all.clone()
    };
    let far = choices("teapot");
    let scalar = METHODS
        .iter()
        .filter(|method| method.scalar_only().is_some())
        .count();
    assert_eq!(
        (&far[0]["engine"], &far[0]["level"]),
        (&"row".into(), &best.name().into())
    );
    assert_eq!(
        (
            &far[0]["reason"],
            far[0]["methods"].as_array().map(Vec::len)
        ),
        (&serde_json::Value::Null, Some(METHODS.len() - scalar))
    );
    // The scalar methods follow, those with the same reason together, and each entry says why.
    for choice in &far[1..] {
        let name = choice["methods"][0].as_str().unwrap();
        let why = MethodRow::named(name).unwrap().scalar_only();
        assert_eq!(
            (choice["engine"].as_str(), choice["reason"].as_str()),
            (Some("span"), why)
        );
    }
    let five = "--light 1,0,1 --light 0,1,1 --light -1,0,1 --light 0,-1,1 --light 0,0,1";
    // Positional lights, many lights and narrow depth buffers do not change the choice.
    for flags in ["--light-at 9,9,9", five, "--depth-bits 16"] {
        assert_eq!(choices(&format!("teapot {flags}")), far, "{flags}");
    }
    let sampled = choices("teapot --depth per-sample");
    assert_eq!(
        (&sampled[0]["engine"], &sampled[0]["level"]),
        (&"span".into(), &"scalar".into())
    );
    assert_eq!(
        sampled[0]["reason"],
        "the row engine interpolates depth and does not compute it per sample"
    );
    assert_eq!(
        sampled[0]["methods"].as_array().map(Vec::len),
        Some(METHODS.len() - scalar)
    );
    folder
        .run("info teapot --light-at 9,9,9")
        .done()
        .prints(&format!("auto     row, {best}: flat, "));
    let with_rows = METHODS.iter().rfind(|entry| entry.scalar_only().is_none());
    let last = with_rows.expect("a method with SIMD").info.name;
    folder
        .run("info teapot --depth per-sample")
        .done()
        .prints(&format!("{last} (the row engine interpolates depth"));
}

#[test]
fn help_and_version_are_results() {
    let folder = Folder::new();
    folder
        .run("--version")
        .done()
        .prints(concat!("fastphong ", env!("CARGO_PKG_VERSION")));
    folder
        .run("--help")
        .done()
        .prints("Exit codes: 0 done, 1 a comparison failed, 2 wrong usage or input");
    for command in ["render", "figure", "diff", "list", "explain", "info"] {
        folder.run("--help").done().prints(command);
        folder
            .run(&format!("{command} --help"))
            .done()
            .prints("Usage: fastphong");
    }
    folder.run("").says("fastphong --help");
}
