//! A secure shell server on the loopback, for as long as a test takes.

use crate::skip;
use std::fs;
use std::net::{Ipv4Addr, TcpListener};
use std::path::Path;
use std::process::{Child, Command};
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::CommandBuilder;

use crate::pty::{self, Term, plain};

const SERVER: &str = "/usr/sbin/sshd";

/// A server of our own, with keys of its own, for as long as a test takes.
pub struct Server {
    folder: tempfile::TempDir,
    process: Child,
    pub port: u16,
    user: String,
}

fn run(program: &str, arguments: &[&str]) -> String {
    let output = Command::new(program).args(arguments).output().unwrap();
    assert!(output.status.success(), "{program} {arguments:?}");
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

fn free_port() -> u16 {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    listener.local_addr().unwrap().port()
}

impl Server {
    /// Starts a server that runs `command` for whoever comes; `None` where there is no server.
    pub fn start(command: &str) -> Option<Self> {
        if !Path::new(SERVER).exists() {
            skip::skip("openssh-server is not installed");
            return None;
        }
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name).display().to_string();
        for key in ["hostkey", "id"] {
            run("ssh-keygen", &["-q", "-t", "ed25519", "-N", "", "-f", &path(key)]);
        }
        let read = |name: &str| fs::read_to_string(path(name)).unwrap();
        let own = format!("restrict,pty,command=\"{command}\" {}", read("id.pub"));
        fs::write(path("authorized_keys"), own).unwrap();
        let user = run("id", &["-un"]);
        if user == "root" {
            fs::create_dir_all("/run/sshd").unwrap();
        }
        let key = read("hostkey.pub");
        let key: Vec<&str> = key.split_whitespace().take(2).collect();
        fs::write(path("known_hosts"), format!("test {}\n", key.join(" "))).unwrap();
        // A port that was free a moment ago may be taken by now: then another is tried.
        for _ in 0..5 {
            let port = free_port();
            fs::write(
                path("sshd_config"),
                format!(
                    "Port {port}\nListenAddress 127.0.0.1\nHostKey {}\nPidFile none\n\
                     AuthorizedKeysFile {}\nPasswordAuthentication no\n\
                     KbdInteractiveAuthentication no\nUsePAM no\nStrictModes no\n\
                     PermitRootLogin prohibit-password\nPrintMotd no\nMaxStartups 100\n",
                    path("hostkey"),
                    path("authorized_keys")
                ),
            )
            .unwrap();
            fs::write(path("log"), "").unwrap();
            let mut process = Command::new(SERVER)
                .args(["-D", "-f", &path("sshd_config"), "-E", &path("log")])
                .spawn()
                .unwrap();
            let begun = Instant::now();
            while process.try_wait().unwrap().is_none() {
                if read("log").contains("Server listening") {
                    return Some(Self { folder, process, port, user });
                }
                assert!(begun.elapsed() < pty::PATIENCE, "the server never listens");
                thread::sleep(Duration::from_millis(20));
            }
        }
        panic!("no server will start: {}", read("log"));
    }

    /// A client of this server, by way of `port`.
    pub fn client(&self, port: u16, compressed: bool) -> CommandBuilder {
        let path = |name: &str| self.folder.path().join(name).display().to_string();
        let mut command = CommandBuilder::new("ssh");
        command.args(["-F", "/dev/null", "-tt", "-p", &port.to_string()]);
        for option in [
            format!("User={}", self.user),
            format!("IdentityFile={}", path("id")),
            format!("UserKnownHostsFile={}", path("known_hosts")),
            "IdentitiesOnly=yes".to_owned(),
            "HostKeyAlias=test".to_owned(),
            "StrictHostKeyChecking=yes".to_owned(),
            "BatchMode=yes".to_owned(),
        ] {
            command.args(["-o", &option]);
        }
        if compressed {
            command.arg("-C");
        }
        command.arg("127.0.0.1");
        plain(&mut command);
        command
    }

    /// The app, once it shows its first result.
    pub fn open(&self) -> Term {
        let term = Term::start(self.client(self.port, false));
        term.wait_for("damage 26 %");
        term
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
