//! `fastphong view`, as far as it goes without a display.

use super::Folder;

#[cfg(not(feature = "view"))]
#[test]
fn a_program_without_windows_says_how_to_get_one() {
    let folder = Folder::new();
    for arguments in ["view", "view teapot", "view teapot --watch -m gouraud"] {
        let told = ["built without windows", "--features view"];
        folder.run(arguments).refused(&told);
    }
    // Without windows, `view` stands in no list of commands.
    let help = folder.run("--help").done();
    assert!(!help.out.contains("  view"), "{}", help.out);
}

#[cfg(feature = "view")]
mod with_windows {
    use super::Folder;
    use crate::Ended;

    /// Runs the program where there is no display.
    fn run(folder: &Folder, arguments: &str) -> Ended {
        let mut command = folder.command(arguments);
        for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
            command.env_remove(display);
        }
        Ended::new(arguments, command.output().expect("the tool runs"))
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn without_a_display_the_tool_says_so() {
        let folder = Folder::new();
        let ended = run(&folder, "view builtin:cube");
        ended.refused(&["no window can be opened", "DISPLAY", "fastphong render"]);
        let mut command = folder.command("view builtin:cube");
        command
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET");
        // An X server may exist under nearly any display number, so choose an unlikely one.
        command.env("DISPLAY", ":4711");
        let output = command.output().expect("the tool runs");
        Ended::new("DISPLAY=:4711", output).refused(&["no window can be opened", "X server"]);
    }

    #[test]
    fn errors_of_the_input_come_first() {
        let folder = Folder::new();
        folder.write("bad.toml", "colour = 1");
        run(&folder, "view bad.toml").refused(&["unknown key `colour`", "bad.toml:1:1"]);
        run(&folder, "view teapot --watch").refused(&["`teapot` is no file"]);
        run(&folder, "view teapot -m all").refused(&["21 methods, and 9 keys"]);
        run(&folder, "view teapot --engine span --simd avx2").refused(&["--engine"]);
    }
}
