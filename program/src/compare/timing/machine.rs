//! The machine and the build of a measurement, without which times mean nothing.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use fastphong::build;
use serde::Serialize;

/// The machine of a measurement, and the build of the library.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// Name of the processor as the system reports it, or `unknown`.
    pub cpu: String,
    /// Logical processors that this program may use.
    pub cores: usize,
    /// Operating system.
    pub os: String,
    /// Processor architecture.
    pub arch: String,
    /// Vector extensions that the compiler could assume.
    pub target_features: Vec<String>,
    /// Compiler, as in `rustc 1.95.0 (…)`.
    pub rustc: String,
    /// `release`, or `debug` for a build with assertions, whose times say nothing.
    pub profile: String,
    /// Optimisation level of the library, which has the methods: `0` to `3`, `s` or `z`.
    pub opt_level: String,
    /// Version of this crate.
    pub version: String,
    /// Commit that it was built from, if `FASTPHONG_COMMIT` was set for the build.
    pub commit: Option<String>,
}

impl Machine {
    /// Describes this machine.
    pub fn this() -> Machine {
        Machine {
            cpu: cpu_name().unwrap_or_else(|| "unknown".to_string()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            os: std::env::consts::OS.to_string(),
            arch: std::env::consts::ARCH.to_string(),
            target_features: target_features().into_iter().map(String::from).collect(),
            rustc: build::RUSTC.to_string(),
            profile: build::PROFILE.to_string(),
            opt_level: build::OPT_LEVEL.to_string(),
            version: env!("CARGO_PKG_VERSION").to_string(),
            commit: option_env!("FASTPHONG_COMMIT").map(String::from),
        }
    }

    /// Returns the description in one line.
    pub fn line(&self) -> String {
        format!(
            "{}, {} {}; {}, {}, opt-level {}; fastphong {}",
            self.cpu, self.os, self.arch, self.rustc, self.profile, self.opt_level, self.version
        )
    }
}

/// Returns the vector extensions of x86-64 and AArch64 that this build assumes.
fn target_features() -> Vec<&'static str> {
    let mut features = Vec::new();
    macro_rules! list {
        ($($name:literal),*) => { $(if cfg!(target_feature = $name) { features.push($name); })* };
    }
    list!(
        "sse2", "sse4.1", "avx", "avx2", "fma", "avx512f", "neon", "sve"
    );
    features
}

#[cfg(any(target_os = "linux", target_os = "android"))]
fn cpu_name() -> Option<String> {
    name_in_cpuinfo(&std::fs::read_to_string("/proc/cpuinfo").ok()?)
}

#[cfg(target_os = "macos")]
fn cpu_name() -> Option<String> {
    let out = std::process::Command::new("sysctl")
        .args(["-n", "machdep.cpu.brand_string"])
        .output()
        .ok()?;
    let name = String::from_utf8(out.stdout).ok()?.trim().to_string();
    (!name.is_empty()).then_some(name)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_os = "macos")))]
fn cpu_name() -> Option<String> {
    std::env::var("PROCESSOR_IDENTIFIER").ok()
}

/// Finds the processor's name in the text of `/proc/cpuinfo`: `model name` on x86, `Model` or
/// `Hardware` on some ARM boards.
#[cfg(any(target_os = "linux", target_os = "android"))]
fn name_in_cpuinfo(text: &str) -> Option<String> {
    let value = |key: &str| {
        let fields = text.lines().filter_map(|line| line.split_once(':'));
        let mut values = fields
            .filter(|field| field.0.trim() == key)
            .map(|field| field.1.trim());
        values.find(|value| !value.is_empty()).map(str::to_string)
    };
    let keys = ["model name", "Model", "Hardware"];
    keys.into_iter().find_map(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_field_says_something() {
        let machine = Machine::this();
        for text in [
            &machine.cpu,
            &machine.os,
            &machine.arch,
            &machine.opt_level,
            &machine.version,
        ] {
            assert!(!text.is_empty(), "{machine:?}");
        }
        assert!(machine.cores >= 1);
        assert!(machine.rustc.starts_with("rustc 1."), "{}", machine.rustc);
        assert!(machine.line().contains(&machine.cpu) && machine.line().contains(&machine.rustc));
        assert!(matches!(&*machine.profile, "debug" | "release"));
    }

    #[cfg(any(target_os = "linux", target_os = "android"))]
    #[test]
    fn cpuinfo_of_x86_and_arm_is_understood() {
        let x86 = "processor\t: 0\nvendor_id\t: GenuineIntel\nmodel\t\t: 85\nmodel name\t: Intel(R) Xeon(R) CPU\n";
        assert_eq!(
            name_in_cpuinfo(x86).as_deref(),
            Some("Intel(R) Xeon(R) CPU")
        );
        let arm = "processor\t: 0\nBogoMIPS\t: 108.00\n\nHardware\t: BCM2835\nModel\t\t: Raspberry Pi 4 Model B\n";
        assert_eq!(
            name_in_cpuinfo(arm).as_deref(),
            Some("Raspberry Pi 4 Model B")
        );
        assert_eq!(name_in_cpuinfo("model name\t:\nprocessor: 0"), None);
        assert_eq!(name_in_cpuinfo(""), None);
    }
}
