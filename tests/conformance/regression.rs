//! Compares today's pictures with the blessed ones, for every shipped scene, method, engine and
//! instruction set of this machine, and for the reference.
//!
//! `FASTPHONG_BLESS=1 cargo test --test conformance regression` blesses today's pictures. Look at
//! each before committing it. Pixels are compared after decoding. A channel may differ by one
//! level. A value within rounding of a half can be stored as either level, if the compiler reorders
//! the reference's operations or another engine draws it.

use crate::support::cases::{case, cases};
use crate::support::differences::levels_apart;
use crate::support::drawings::for_each_drawing;
use fastphong::compare::metrics::difference_map;
use fastphong::picture::Picture8;
use fastphong::picture::encoding::store as store_levels;
use fastphong::picture::image_file::{encode_png, read_picture, write_file};
use fastphong::raster::{Plan, Renderer};
use fastphong::reference::Model;
use fastphong::shading::{METHODS, MethodRow};
use std::fs;
use std::path::{Path, PathBuf};

const SIZE: (i64, i64) = (128, 96);

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn store(path: &Path, picture: &Picture8) {
    fs::create_dir_all(path.parent().expect("a folder")).expect("a writable target folder");
    write_file(path, &encode_png(picture).expect("a picture with pixels"))
        .expect("a writable file");
}

/// Compares `actual` with its blessed picture, or blesses it if asked to. Returns a message if they
/// differ, and writes `actual` and the difference.
fn check(name: &str, actual: &Picture8) -> Option<String> {
    if std::env::var_os("FASTPHONG_BLESS").is_some() {
        store(&blessed(name), actual);
        return None;
    }
    check_where(name, &blessed(name), actual, |_, _| true)
}

/// Returns the path of a blessed picture.
fn blessed(name: &str) -> PathBuf {
    folder("tests/references").join(format!("{name}.png"))
}

/// Compares colours where `counts` holds and coverage everywhere. Returns a message if they differ,
/// and writes `actual` and the difference.
fn check_where(
    name: &str,
    blessed: &Path,
    actual: &Picture8,
    counts: impl Fn(usize, usize) -> bool,
) -> Option<String> {
    let output = folder("target/regression").join(format!("{name}.actual.png"));
    let expected = match read_picture(blessed).map(|picture| picture.to_stored()) {
        Ok(expected) => expected,
        Err(error) => {
            store(&output, actual);
            return Some(format!(
                "{name}: {error}; the candidate is {}",
                output.display()
            ));
        }
    };
    let (levels, uncovered) = levels_apart(&expected, actual, counts);
    if levels <= 1 && uncovered == 0 {
        return None;
    }
    let map = folder("target/regression").join(format!("{name}.difference.png"));
    store(&output, actual);
    store(
        &map,
        &difference_map(&expected, actual, 16.0).expect("equal sizes"),
    );
    Some(format!(
        "{name}: off by {levels} levels, {uncovered} pixels drawn in one only; see {} and {}",
        output.display(),
        map.display()
    ))
}

#[test]
fn pictures_are_the_blessed_ones() {
    let mut failures = Vec::new();
    let mut known = Vec::new();
    let models = [
        (Model::Phong, "reference"),
        (Model::Slerp, "reference-slerp"),
    ];
    for case in cases(Some(SIZE)) {
        for (model, file) in models {
            let picture = store_levels(case.truth(model), case.frame.encoding());
            failures.extend(check(&format!("{}/{file}", case.name), &picture));
        }
        let is_drawn = |entry: &&'static MethodRow| {
            let plan = entry.variant().plan(&case.frame, Renderer::LECTURE);
            !matches!(plan, Plan::Refused(_))
        };
        let methods = METHODS.iter().filter(is_drawn);
        let methods = methods.map(|entry| entry.info.name);
        let files = models.iter().map(|(_, file)| *file).chain(methods);
        known.extend(files.map(|file| blessed(&format!("{}/{file}", case.name))));
    }
    // The span engine's picture is the blessed one; others may differ where rounding decides visibility.
    let drawn = for_each_drawing(cases(Some(SIZE)), |drawing| {
        let name = format!("{}/{}", drawing.case.name, drawing.variant.info().name);
        if drawing.is_by_spans() {
            return check(&name, &drawing.stored());
        }
        let decided = drawing.case.decided();
        let file = &blessed(&name);
        check_where(&drawing.to_string(), file, &drawing.stored(), |x, y| {
            decided.get(x, y)
        })
    });
    failures.extend(drawn.into_iter().flatten());
    // A blessed picture that nothing renders any more could never fail.
    for folder in fs::read_dir(folder("tests/references"))
        .expect("the folder of blessed pictures")
        .flatten()
    {
        for file in fs::read_dir(folder.path()).into_iter().flatten().flatten() {
            if !known.contains(&file.path()) {
                failures.push(format!(
                    "{} belongs to no scene and method",
                    file.path().display()
                ));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} pictures differ:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// The comparison rejects a pixel that is off by two levels and another method's picture.
#[test]
fn the_comparison_detects_two_levels() {
    let frame = &case("coarse-sphere", Some(SIZE)).frame;
    let picture = |name: &str| {
        fastphong::shading::Variant::parse(name)
            .expect("a method")
            .render(frame)
            .expect("a method for the frame")
    };
    let naive = picture("naive-phong");
    let mut moved = naive.clone();
    let lit = moved
        .pixels()
        .iter()
        .position(|t| t[0] > 100 && t[0] < 250)
        .expect("a lit pixel");
    moved.pixels_mut()[lit][0] += 2;
    let levels = |other: &Picture8| levels_apart(&naive, other, |_, _| true).0;
    assert!(levels(&moved) > 1);
    assert!(levels(&picture("gouraud")) > 1);
    assert!(levels(&picture("fast-phong")) <= 1);
}
