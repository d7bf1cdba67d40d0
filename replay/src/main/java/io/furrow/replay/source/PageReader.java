package io.furrow.replay.source;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.mission.LatestState;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingGoneException;
import io.furrow.mission.Recordings;
import io.furrow.mission.StoredEvent;
import io.furrow.replay.playback.Fetch;
import io.furrow.replay.playback.Fetched;

/**
 * Reads the recording of one replay, in a thread that it has as long as there is something to read: a recording that is slow or away
 * holds up no other. What cannot be read now is tried again, at first after a second, then after ever longer, half a minute at most.
 */
final class PageReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(PageReader.class);
    private static final long FIRST_RETRY_MILLIS = 1_000;
    private static final long LONGEST_RETRY_MILLIS = 30_000;
    private static final long IDLE_SECONDS = 10;

    private final String mission;
    private final Recordings recordings;
    private final PageLimits limits;
    private final Consumer<Fetched> out;
    private final ScheduledThreadPoolExecutor thread;
    private volatile Fetch newest;
    private Recording recording;

    /** @param out takes the answers, in the reading thread */
    PageReader(String mission, Recordings recordings, PageLimits limits, Consumer<Fetched> out) {
        this.mission = mission;
        this.recordings = recordings;
        this.limits = limits;
        this.out = out;
        thread = new ScheduledThreadPoolExecutor(1, task -> {
            Thread reader = new Thread(task, "replay-pages-" + mission);
            reader.setDaemon(true);
            return reader;
        });
        thread.setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
        thread.allowCoreThreadTimeOut(true);
    }

    /** Reads in place of what it was still asked for. */
    void read(Fetch fetch) {
        newest = fetch;
        thread.execute(() -> attempt(fetch, FIRST_RETRY_MILLIS));
    }

    private void attempt(Fetch fetch, long retryMillis) {
        if (fetch != newest) {
            return;
        }
        try {
            out.accept(answer(fetch));
        } catch (RecordingGoneException e) {
            release();
            out.accept(new Fetched.Gone(fetch.epoch(), e.getMessage()));
        } catch (RecordingException e) {
            release();
            LOG.info("Recording of mission {} is awaited", mission, e);
            out.accept(new Fetched.Waiting(fetch.epoch(), e.getMessage()));
            long longer = Math.min(2 * retryMillis, LONGEST_RETRY_MILLIS);
            thread.schedule(() -> attempt(fetch, longer), retryMillis, TimeUnit.MILLISECONDS);
        } catch (RuntimeException | Error e) { // a fault of the reader is this replay's end, and nobody else's
            release();
            LOG.error("Recording of mission {} cannot be read", mission, e);
            out.accept(new Fetched.Gone(fetch.epoch(), "the recording cannot be read: " + e));
        }
    }

    private Fetched answer(Fetch fetch) throws RecordingException {
        if (recording == null) {
            Optional<Recording> opened = recordings.open(mission);
            if (opened.isEmpty()) {
                return new Fetched.Gone(fetch.epoch(), "there is no mission '" + mission + "'");
            }
            recording = opened.get();
        }
        if (fetch instanceof Fetch.Begin begin) {
            List<StoredEvent> primes =
                    begin.primed() ? new ArrayList<>(LatestState.before(recording, begin.point(), limits)) : List.of();
            return new Fetched.Begun(begin.epoch(), primes, recording.read(begin.first(), limits));
        } else if (fetch instanceof Fetch.Next next) {
            return new Fetched.More(next.epoch(), recording.read(next.after(), limits));
        }
        return new Fetched.Opened(fetch.epoch(), recording.span());
    }

    private void release() {
        Recording released = recording;
        recording = null;
        if (released != null) {
            try {
                released.close();
            } catch (RuntimeException e) {
                LOG.warn("Recording of mission {} was not closed", mission, e);
            }
        }
    }

    /** Asks no more for what it was asked for, and holds no connection until it is asked again. */
    void rest() {
        newest = null;
        thread.execute(this::release);
    }

    @Override
    public void close() {
        newest = null;
        thread.getQueue().clear();
        thread.execute(this::release);
        thread.shutdown();
    }
}
