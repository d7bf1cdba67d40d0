package io.furrow.simulators.fiware;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Keeps the state of a stand-in in a file: read once, then written on its own thread some seconds after a change and when it is
 * closed. While nothing changes nothing is written.
 */
final class StateKeeper implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(StateKeeper.class);
    private static final Duration PAUSE = Duration.ofSeconds(5);
    private static final long CLOSE_SECONDS = 30;

    private final StateFile file;
    private final KeptState state;
    private final Revision revision;
    private final ScheduledExecutorService writer = Executors.newSingleThreadScheduledExecutor(StateKeeper::thread);
    private long saved;
    private boolean failing;

    /**
     * Reads the file, if there is one, and begins to watch for changes.
     *
     * @throws IllegalStateException if the file is damaged
     * @throws UncheckedIOException if it cannot be read
     */
    static StateKeeper open(Path path, KeptState state, Revision revision) {
        StateFile file = new StateFile(path);
        try {
            file.read(state::restore);
        } catch (StateFile.DamagedException e) {
            throw new IllegalStateException(
                    "the FIWARE stand-in cannot start from its state in " + file + ", the file is damaged ("
                            + e.getMessage() + "); put a copy in its place, or move it away to start with nothing",
                    e);
        } catch (IOException e) {
            throw new UncheckedIOException(
                    "the FIWARE stand-in cannot read its state in " + file + "; may this user read it?", e);
        }
        return new StateKeeper(file, state, revision);
    }

    private StateKeeper(StateFile file, KeptState state, Revision revision) {
        this.file = file;
        this.state = state;
        this.revision = revision;
        saved = revision.current();
        writer.scheduleWithFixedDelay(this::save, PAUSE.toMillis(), PAUSE.toMillis(), TimeUnit.MILLISECONDS);
    }

    @Override
    public void close() {
        writer.shutdown();
        try {
            if (!writer.awaitTermination(CLOSE_SECONDS, TimeUnit.SECONDS)) {
                LOG.warn("Still writing {}", file);
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        save();
    }

    private synchronized void save() {
        // Read first: what changes while the file is written is written the next time.
        long now = revision.current();
        if (now == saved) {
            return;
        }
        try {
            file.write(state.lines());
            saved = now;
            failing = false;
        } catch (IOException e) {
            if (!failing) {
                LOG.error("The state of the FIWARE stand-in cannot be written to {}; it is tried again", file, e);
            }
            failing = true;
        }
    }

    private static Thread thread(Runnable work) {
        Thread thread = new Thread(work, "furrow-fiware-state");
        thread.setDaemon(true);
        return thread;
    }
}
