//! `fastphong render --aov`: pictures of depth, normals, polygons and other data of each pixel.

use super::{Folder, SPHERE, picture};
use fastphong::picture::image_file::{FilePixels, read_picture};

#[test]
fn aovs_show_depth_normals_and_polygons() {
    let folder = Folder::new();
    for aov in ["depth", "normal", "polygon"] {
        folder
            .run(&format!(
                "render {SPHERE} --view 0,0 --aov {aov} -o {aov}.png"
            ))
            .done()
            .says(&format!("64x48, {aov}"));
        folder
            .run(&format!(
                "render {SPHERE} --view 0,0 --aov {aov} -o {aov}.pfm"
            ))
            .done();
    }
    let depth = picture(&folder.path("depth.png"));
    let drawn = depth.pixels().iter().filter(|pixel| pixel[3] == 255);
    assert_eq!(
        drawn.clone().map(|pixel| pixel[0]).max(),
        Some(255),
        "the nearest pixel is white"
    );
    assert_eq!(
        drawn.map(|pixel| pixel[0]).min(),
        Some(0),
        "the farthest pixel is black"
    );
    assert!(depth.get(32, 24)[0] > 200 && depth.get(0, 0) == [0; 4]);
    // The middle normal points along z: (N + 1)/2 = (½, ½, 1). The facets there lean by less than
    // 30 degrees.
    let [r, g, b, _] = picture(&folder.path("normal.png")).get(32, 24);
    assert!(
        r.abs_diff(128) < 64 && g.abs_diff(128) < 64 && b > 237,
        "{r} {g} {b}"
    );

    let floats = |name: &str| match read_picture(&folder.path(name)).unwrap().pixels {
        FilePixels::Linear(floats) => floats,
        _ => panic!("{name} holds no floats"),
    };
    let raw = floats("depth.pfm");
    assert!((0.0..1.0).contains(&raw.get(32, 24)[0]) && raw.get(0, 0)[0] == f32::INFINITY);
    let (numbers, colours) = (floats("polygon.pfm"), picture(&folder.path("polygon.png")));
    assert_eq!(numbers.get(0, 0)[0], -1.0);
    let mut neighbours = 0;
    for y in 0..48 {
        for x in 1..64 {
            let same = numbers.get(x - 1, y)[0] == numbers.get(x, y)[0];
            assert_eq!(
                colours.get(x - 1, y) == colours.get(x, y),
                same,
                "column {x}, row {y}"
            );
            neighbours += usize::from(!same);
        }
    }
    assert!(neighbours > 100, "{neighbours}");
    folder
        .run(&format!("render {SPHERE} --aov depth -m flat -o out.png"))
        .refused(&["cannot be used with"]);
}

/// `--aov kind` shows which of its kinds the requested method chose for each polygon.
#[test]
fn aovs_show_kinds_of_polygons() {
    let folder = Folder::new();
    let ball = "render builtin:sphere?rings=6&segments=12 --size 400x300 --aov kind";
    folder
        .run(&format!("{ball} -o kind.pfm"))
        .done()
        .says("adaptive-phong: polygons by kind: 0 phong-rsqrt (grey), ");
    let kinds = match read_picture(&folder.path("kind.pfm")).unwrap().pixels {
        FilePixels::Linear(floats) => floats,
        _ => panic!("floats"),
    };
    let seen: std::collections::BTreeSet<i32> =
        kinds.pixels().iter().map(|pixel| pixel[0] as i32).collect();
    assert!(seen.contains(&-1) && seen.len() >= 3, "{seen:?}");
    folder
        .run(&format!("{ball} -m six-point -o six.png"))
        .done()
        .says("six-point: polygons by kind: 9 quadratic (grey), 27 duff-phong (blue)");
    let six = picture(&folder.path("six.png"));
    let colours: std::collections::BTreeSet<[u8; 4]> = six.pixels().iter().copied().collect();
    let expected = [[0; 4], [86, 180, 233, 255], [153, 153, 153, 255]];
    assert_eq!(Vec::from_iter(colours), expected);
    folder.run(&format!("{ball} -m flat -o out.png")).refused(&[
        "flat has only one kind of polygons: expected one of series-phong, cubic-phong",
    ]);
}

/// AOVs show vertex colours of a triangle with a red, a green and a blue corner, and a checkerboard
/// on a floor of 4 × 4 world units.
#[test]
fn aovs_show_vertex_colours_and_a_checkerboard() {
    let folder = Folder::new();
    folder.write(
        "rgb.obj",
        "v 0 0 0 1 0 0\nv 4 0 0 0 1 0\nv 0 4 0 0 0 1\nf 1 2 3\n",
    );
    let view = "--view 0,0 --size 40x40";
    folder
        .run(&format!("render rgb.obj {view} --aov colours -o rgb.png"))
        .done()
        .says("40x40, colours");
    let rgb = picture(&folder.path("rgb.png"));
    // The weights sum to 1, so the colours sum to 255, up to half a level for each of three
    // roundings.
    let drawn: Vec<[u8; 4]> = rgb
        .pixels()
        .iter()
        .copied()
        .filter(|t| t[3] == 255)
        .collect();
    assert!(
        drawn.len() > 200
            && drawn.iter().all(|t| t[..3]
                .iter()
                .map(|&c| i32::from(c))
                .sum::<i32>()
                .abs_diff(255)
                <= 1)
    );
    for channel in 0..3 {
        assert!(
            drawn.iter().any(|t| t[channel] > 230),
            "a corner of channel {channel}"
        );
    }
    folder.write(
        "floor.obj",
        "v 0 0 0\nv 0 0 4\nv 4 0 4\nv 4 0 0\nf 1 2 3 4\n",
    );
    let view = "--view 0,90 --size 40x40";
    for (square, squares) in [("1", 16), ("2", 4), ("8", 1)] {
        folder
            .run(&format!(
                "render floor.obj {view} --aov checkerboard --square {square} -o board.png"
            ))
            .done();
        let board = picture(&folder.path("board.png"));
        let (mut light, mut dark) = (0, 0);
        for t in board.pixels().iter().filter(|t| t[3] == 255) {
            *(if t[0] > 128 { &mut light } else { &mut dark }) += 1;
        }
        // Half of the squares are light and half are dark, unless there is only one square.
        assert!(
            light > 300 && (squares == 1) == (dark == 0),
            "{square}: {light}, {dark}"
        );
        assert!(
            squares == 1 || light * 10 < dark * 13 && dark * 10 < light * 13,
            "{square}: {light}, {dark}"
        );
    }
    folder
        .run("render floor.obj --aov checkerboard --square 0 -o out.png")
        .refused(&["expected a length in world units"]);
    folder
        .run("render floor.obj --square 2 -o out.png")
        .refused(&["--aov"]);
}
