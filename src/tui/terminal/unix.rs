//! What Unix alone has: signals, the stop of a job, a terminal that is a file.

use std::fs::File;
use std::io::{self, Read, Write};
use std::os::fd::AsFd;
use std::sync::mpsc::SyncSender;
use std::thread;
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use signal_hook::consts::signal::SIGXFSZ;
use signal_hook::consts::{
    SIGABRT, SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1,
    SIGUSR2, SIGVTALRM, SIGWINCH, SIGXCPU,
};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;

use crate::run::threads;
use crate::tui::terminal::{event::Event, pacer::Pacer, session};

/// Where the app draws: a handle of its own takes no lock, so a panic on any thread can write.
pub(super) type Out = File;

/// The time to leave by itself after a signal. A terminal that does not read holds the app up.
const LAST_CALL: Duration = Duration::from_secs(2);

/// Opens what is drawn on.
pub(super) fn out() -> io::Result<Out> {
    Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
}

/// Frames wait for replies: nobody knows how far the terminal is.
pub(super) fn pacer() -> Pacer {
    Pacer::default()
}

/// Asks for presses, drags and the wheel; a mouse that merely moves sends nothing.
const MOUSE_ON: &[u8] = b"\x1b[?1002h\x1b[?1006h";
const MOUSE_OFF: &[u8] = b"\x1b[?1002l\x1b[?1006l";

/// Has the terminal report its mouse, or no longer.
pub(super) fn listen_to_mouse(mut out: &Out, listen: bool) -> io::Result<()> {
    out.write_all(if listen { MOUSE_ON } else { MOUSE_OFF })
}

/// What is said once the terminal is given back; when memory runs out nothing else can be.
const ABORTED: &[u8] = b"contrecoup: aborted; either memory ran out or somebody asked for it\r\n";
/// How long a terminal is waited for which does not read.
const LAST_WORDS: Timespec = Timespec { tv_sec: 0, tv_nsec: 200_000_000 };

/// Gives the terminal back when the program aborts, as it does when memory runs out: by then no
/// thread of it runs any more, and nothing can be allocated. `is_entered` says whether there is
/// anything to give back, and must do no more than that.
#[expect(unsafe_code, reason = "no safe call gives a signal handler more to do than to set a flag")]
pub(super) fn restore_on_abort(is_entered: fn() -> bool) -> io::Result<()> {
    let out = out()?;
    let modes = tcgetattr(&out)?;
    let handler = move || {
        if is_entered() {
            let mut ready = [PollFd::new(&out, PollFlags::OUT)];
            if matches!(poll(&mut ready, Some(&LAST_WORDS)), Ok(1)) {
                for bytes in [MOUSE_OFF, session::LEAVE, ABORTED] {
                    let _ = rustix::io::write(&out, bytes);
                }
            }
            let _ = tcsetattr(&out, OptionalActions::Now, &modes);
        }
        let _ = emulate_default_handler(SIGABRT);
    };
    // SAFETY: the handler reads an atomic, makes system calls that are allowed in one (poll, write
    // and tcsetattr of POSIX) and neither allocates, locks nor panics.
    unsafe { signal_hook::low_level::register(SIGABRT, handler)? };
    Ok(())
}

/// Listens to every signal that would end or stop the app and leave the terminal as it is.
pub(super) fn signals() -> io::Result<Signals> {
    let asked = [SIGTERM, SIGINT, SIGQUIT, SIGHUP, SIGUSR1, SIGUSR2];
    // Of clocks, and of `ulimit -t`.
    let clocks = [SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU];
    let others = [SIGWINCH, SIGCONT, SIGXFSZ];
    Signals::new(asked.into_iter().chain(clocks).chain(others))
}

/// Sends what is typed and which signals come.
pub(super) fn listen(send: &SyncSender<Event>, mut signals: Signals) -> io::Result<()> {
    let sender = send.clone();
    threads::start(move || {
        let mut told = false;
        for signal in signals.forever() {
            let event = match signal {
                SIGCONT => Event::Continued,
                SIGWINCH => Event::Resized,
                // The write that went beyond the limit fails by itself, and that is shown.
                SIGXFSZ => continue,
                end => {
                    let code = 128 + end;
                    if told {
                        session::abandon(code);
                    }
                    told = true;
                    // Without a thread for it the app has all the time it takes.
                    let _ = threads::start(move || {
                        thread::sleep(LAST_CALL);
                        session::abandon(code);
                    });
                    Event::end(u8::try_from(code).unwrap_or(1))
                }
            };
            if sender.send(event).is_err() {
                return;
            }
        }
    })?;
    let sender = send.clone();
    threads::start(move || read_keyboard(&sender))
}

/// So many bytes are read at once: what is typed faster than it is done waits in the terminal.
const BITE: usize = 256;

fn read_keyboard(send: &SyncSender<Event>) {
    let mut keyboard = io::stdin().lock();
    let mut bytes = [0; BITE];
    let mut is_open = true;
    while is_open {
        let event = match keyboard.read(&mut bytes) {
            Ok(count @ 1..) => Event::Bytes(bytes[..count].to_vec()),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            _ => {
                is_open = false;
                Event::hangup()
            }
        };
        is_open &= send.send(event).is_ok();
    }
}

/// Stops the process until the shell goes on with it.
pub(super) fn stop() -> io::Result<()> {
    signal_hook::low_level::raise(SIGTSTP)
}
