//! Defaults of the tool.

use super::Folder;
use fastphong::number::SimdLevel;

/// Without `--method` the tool draws naive Phong's picture, which fast Phong does not under
/// positional lights. `--verbose` names the method and the reason.
#[test]
fn auto_is_the_default_method_and_names_its_choice() {
    let folder = Folder::new();
    let scene = "render two-lights --size 160x120";
    folder
        .run(&format!("{scene} -m naive-phong -o naive.png"))
        .done();
    let like_naive = |flags: &str| folder.run(&format!("{scene} {flags} --reference naive.png"));
    for flags in [
        "",
        "-m auto",
        "--simd scalar",
        "--engine cs171",
        "--engine barycentric",
    ] {
        let flags = format!("{flags} --reference-threshold 1");
        like_naive(&flags).done();
    }
    like_naive("-m fast-phong --reference-threshold 1").differs();
    let take = |flags: &str, method: &str| {
        let picture = folder
            .run(&format!("{scene} {flags} -o out.png --verbose"))
            .done();
        picture
            .says(&format!("method {method}, chosen by auto: "))
            .says(&format!("out.png: 160x120, {method}\n"));
    };
    if SimdLevel::best() != SimdLevel::Scalar {
        take("", "phong-rsqrt");
    }
    take("--simd scalar", "naive-phong");
    take(
        "--simd scalar --light 1,1,1 --viewer infinite",
        "phong-rsqrt",
    );
    take("--engine cs171", "naive-phong");
    let quiet = folder.run(&format!("{scene} -o out.png")).done();
    assert!(!quiet.err.contains("auto"), "{}", quiet.err);
    let named = folder
        .run(&format!("{scene} -m gouraud -o out.png --verbose"))
        .done();
    assert!(!named.err.contains("auto"), "{}", named.err);

    folder
        .run("info teapot")
        .done()
        .prints("phong-rsqrt (chosen by auto: ");
    let json = folder.run("info teapot --json").done().json();
    assert_eq!(json["method"]["name"], "phong-rsqrt");
    folder
        .run("render teapot -m atuo -o out.png")
        .refused(&["did you mean `auto`?"]);
}

/// Without arguments the tool prints five working commands and where to find help. The exit code is
/// 2, as for all wrong usage.
#[test]
fn without_arguments_five_commands_are_suggested() {
    let folder = Folder::new();
    let ended = folder.run("");
    assert_eq!((ended.code, &*ended.out), (Some(2), ""));
    let said = ended.says("fastphong --help").err;
    let commands: Vec<&str> = said
        .lines()
        .filter_map(|line| line.strip_prefix("  fastphong ")?.split("  ").next())
        .collect();
    assert_eq!(commands.len(), 5, "{said}");
    // Skip the last command, which takes a minute.
    for command in &commands[..4] {
        folder.run(command).done();
    }
    assert_eq!(folder.names(), ["report", "teapot.png"]);
    assert!(said.lines().all(|line| line.len() <= 100), "{said}");
}

/// A mesh that is wound the wrong way draws nothing: `render` and `compare` both warn. If only some
/// polygons are culled, `compare` counts them and nobody warns.
#[test]
fn culled_polygons_are_reported() {
    let folder = Folder::new();
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    folder.write("back.obj", format!("{corners}f 1 3 2\n"));
    folder.write("both.obj", format!("{corners}f 1 3 2\nf 1 2 3\n"));
    let warning =
        "warning: nothing is drawn: 1 polygon is seen from the culled side; try --cull none";
    folder
        .run("render back.obj -o back.png --cull back")
        .done()
        .says(warning);
    let compare = "compare back.obj --methods flat --size 32x32 --time-budget 0 --cull back";
    folder.run(compare).done().says(warning);
    let front = folder.run("render both.obj -o both.png").done();
    assert!(!front.err.contains("warning"), "{}", front.err);
    folder
        .run("compare both.obj --methods flat --size 32x32 --time-budget 0")
        .done()
        .prints("both.obj: 32×32, 1 of 2 polygons, ")
        .says("--simd auto compares in the engine that `render` uses");
    folder
        .run("info back.obj")
        .done()
        .prints("1, 1 polygon in all");
}

/// The answer to an unknown method is the nearest name, a name that contains it, or every name that
/// the flag accepts.
#[test]
fn unknown_methods_are_answered_with_names() {
    let folder = Folder::new();
    for command in [
        "render teapot -o out.png -m phong",
        "compare teapot --methods phong",
        "explain phong",
    ] {
        folder
            .run(command)
            .refused(&["unknown method `phong`", "did you mean `naive-phong`?"]);
    }
    folder
        .run("render teapot -o out.png -m pong")
        .refused(&["`integer-fast-printed`, `auto`, `reference`"]);
}

/// The usage of `render` names the flags of which one is required. Each usage line that it shows
/// works.
#[test]
fn usage_of_render_names_the_required_flags() {
    let folder = Folder::new();
    folder
        .run("render --help")
        .done()
        .prints("[OPTIONS] --output <FILE> <INPUT>")
        .prints("[OPTIONS] --reference <FILE> <INPUT>")
        .prints("[OPTIONS] <--stats|--print-scene> <INPUT>");
    folder.run("render teapot").refused(&["--output <FILE>"]);
    for needed in [
        "--output a.png",
        "--reference a.png",
        "--stats",
        "--print-scene",
    ] {
        let run = folder.run(&format!("render teapot --size 8x8 {needed}"));
        assert!(run.code != Some(2), "{needed}: {}", run.err);
    }
}
