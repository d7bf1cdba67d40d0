package io.furrow.replay.source;

import java.io.IOException;
import java.util.HashSet;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.Future;
import java.util.concurrent.ScheduledThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.DaemonThreads;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.text.FailureText;
import io.furrow.replay.playback.ReadRequest;
import io.furrow.replay.playback.ReadResult;
import io.furrow.replay.playback.ReadyEvent;
import io.furrow.replay.playback.ReadyPage;
import io.furrow.replay.record.EventEncoder;
import io.furrow.replay.recording.PageBudget;

/**
 * Reads the recording of one replay in its own thread, so that a slow or unavailable recording delays no other replay.
 * Failed reads are retried after 1 s, then at growing intervals of up to 30 s.
 */
final class PageReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(PageReader.class);
    private static final long FIRST_RETRY_MILLIS = 1_000;
    private static final long MAX_RETRY_MILLIS = 30_000;
    private static final long IDLE_SECONDS = 10;
    private static final int MAX_LOGGED = 10;
    /** Limits of pages that are scanned but not played. */
    private static final PageLimits SCANNED = new PageLimits(100, 128 * 1024);

    private final DesiredReplay replay;
    private final Preparation preparation;
    private final RunningReplay.Reading shared;
    private final Consumer<ReadResult> out;
    private final PageBudget.Pages pages;
    private final ScheduledThreadPoolExecutor thread;
    private volatile ReadRequest newest;
    /** The read in progress or its retry. */
    private Future<?> reading;

    private boolean prepared;
    /** States of the last beginning, which the next pass of a loop reuses; null if there are none. */
    private List<StoredEvent> primes;

    private long primesPoint;
    /** Skipped documents that were logged. */
    private final Set<String> loggedSkips = new HashSet<>();

    private Recording recording;
    private EventEncoder encoder;
    private long encodedEpoch;

    /** Prepares the replay before its first page is read. */
    interface Preparation {
        void run() throws IOException, InterruptedException;
    }

    /** @param out accepts the results, called by the reading thread */
    PageReader(DesiredReplay replay, Preparation preparation, RunningReplay.Reading shared, Consumer<ReadResult> out) {
        this.replay = replay;
        this.preparation = preparation;
        this.shared = shared;
        this.out = out;
        this.pages = shared.budget().pages();
        thread = new ScheduledThreadPoolExecutor(1, DaemonThreads.named("replay-pages-" + replay.replay()));
        thread.setKeepAliveTime(IDLE_SECONDS, TimeUnit.SECONDS);
        thread.allowCoreThreadTimeOut(true);
    }

    /** Interrupts a request in progress and reads for this one. */
    synchronized void read(ReadRequest readRequest) {
        newest = readRequest;
        interrupt();
        reading = thread.submit(() -> attempt(readRequest, FIRST_RETRY_MILLIS));
    }

    private void interrupt() {
        if (reading != null) {
            reading.cancel(true);
        }
    }

    /** Runs the preparation without a request. */
    void prepareSoon() {
        thread.execute(() -> prepareWithRetry(FIRST_RETRY_MILLIS));
    }

    private void prepareWithRetry(long retryMillis) {
        try {
            prepare();
        } catch (IOException e) {
            LOG.info("Replay {} waits for its topic", replay.replay(), e);
            if (!thread.isShutdown()) {
                long nextRetryMillis = Math.min(2 * retryMillis, MAX_RETRY_MILLIS);
                thread.schedule(() -> prepareWithRetry(nextRetryMillis), retryMillis, TimeUnit.MILLISECONDS);
            }
        } catch (InterruptedException e) {
            LOG.debug("Replay {} is closed", replay.replay(), e);
        }
    }

    private void attempt(ReadRequest readRequest, long retryMillis) {
        if (readRequest != newest) {
            return;
        }
        try {
            prepare();
            out.accept(answer(readRequest));
        } catch (InterruptedException | RecordingInterruptedException e) { // the recording stays open
            LOG.debug("Reading {} of replay {} was cancelled", readRequest, replay.replay(), e);
        } catch (RecordingDeletedException e) {
            release();
            out.accept(new ReadResult.Failed(readRequest.epoch(), e.getMessage()));
        } catch (IOException e) { // of the recording or the topic
            release();
            LOG.info("Replay {} waits for its recording or topic", replay.replay(), e);
            out.accept(new ReadResult.Unavailable(readRequest.epoch(), e.getMessage()));
            long nextRetryMillis = Math.min(2 * retryMillis, MAX_RETRY_MILLIS);
            retry(readRequest, nextRetryMillis, retryMillis);
        } catch (RuntimeException | Error e) { // a defect of the reader fails this replay only
            release();
            LOG.error("Recording of replay {} cannot be read", replay.replay(), e);
            out.accept(
                    new ReadResult.Failed(readRequest.epoch(), "the recording cannot be read: " + FailureText.of(e)));
        }
    }

    private synchronized void retry(ReadRequest readRequest, long nextRetryMillis, long afterMillis) {
        if (readRequest == newest) {
            reading = thread.schedule(() -> attempt(readRequest, nextRetryMillis), afterMillis, TimeUnit.MILLISECONDS);
        }
    }

    private void prepare() throws IOException, InterruptedException {
        if (!prepared) {
            preparation.run();
            prepared = true;
        }
    }

    private ReadResult answer(ReadRequest readRequest) throws IOException, InterruptedException {
        if (recording == null) {
            Optional<Recording> opened = shared.recordings().open(replay);
            if (opened.isEmpty()) {
                return new ReadResult.Failed(readRequest.epoch(), missingMessage());
            }
            recording = opened.get();
        }
        if (readRequest instanceof ReadRequest.Begin begin) {
            if (!begin.primed() || primes == null || primesPoint != begin.point()) {
                primes = begin.primed() ? recording.stateBefore(begin.point(), devices(), SCANNED) : List.of();
                primesPoint = begin.point();
            }
            List<ReadyEvent> ready = encoder(begin).primes(primes, begin.point());
            primes = begin.repeats() ? primes : null;
            return new ReadResult.Primed(begin.epoch(), ready, page(begin, begin.first(), begin.events()));
        } else if (readRequest instanceof ReadRequest.Next next) {
            return new ReadResult.NextPage(next.epoch(), page(next, next.after(), next.events()));
        } else if (readRequest instanceof ReadRequest.Back back) {
            return new ReadResult.SteppedBack(back.epoch(), back.count(), back(back));
        }
        pages.clear();
        return new ReadResult.Opened(readRequest.epoch(), recording.span());
    }

    private ReadyPage page(ReadRequest readRequest, Cursor after, int events) throws IOException, InterruptedException {
        try {
            EventPage eventPage = recording.read(after, pages.next(events));
            logSkipped(eventPage);
            ReadyPage ready = encoder(readRequest).page(eventPage);
            pages.add(ready);
            return ready;
        } finally {
            pages.settle();
        }
    }

    private void logSkipped(EventPage eventPage) {
        for (SkippedRecords skippedRecords : eventPage.skipped()) {
            if (loggedSkips.size() < MAX_LOGGED
                    && loggedSkips.add(skippedRecords.what() + ": " + skippedRecords.reason())) {
                LOG.info(
                        "Replay {} skips {} ({}): {}",
                        replay.replay(),
                        skippedRecords.what(),
                        skippedRecords.count(),
                        skippedRecords.reason());
            }
        }
    }

    private EventEncoder encoder(ReadRequest readRequest) {
        if (encoder == null || encodedEpoch != readRequest.epoch()) {
            encodedEpoch = readRequest.epoch();
            encoder = new EventEncoder(replay, encodedEpoch, shared.topics()::writable);
        }
        return encoder;
    }

    private String missingMessage() {
        ReplayPlan.Source source = replay.plan().source();
        if (source == null) {
            return "there is no mission '" + replay.mission() + "'";
        }
        return source.topic() == null
                ? "there is no file '" + source.file() + "' in the folder of --recordings"
                : "there is no topic '" + source.topic() + "'";
    }

    private Cursor back(ReadRequest.Back back) throws RecordingException {
        Set<String> devices = devices();
        return recording.back(
                back.from(),
                back.first(),
                back.count(),
                event -> devices.isEmpty() || devices.contains(event.entityId()),
                SCANNED);
    }

    private Set<String> devices() {
        return Set.copyOf(replay.plan().devices());
    }

    private void release() {
        Recording released = recording;
        recording = null;
        primes = null;
        encoder = null;
        if (released != null) {
            try {
                released.close();
            } catch (RuntimeException e) {
                LOG.warn("Recording of replay {} was not closed", replay.replay(), e);
            }
        }
    }

    /** Cancels the request in progress and closes the recording until the next request. */
    synchronized void suspend() {
        newest = null;
        interrupt();
        thread.execute(() -> {
            prepared = false; // the topic may be deleted until then
            release();
            pages.clear();
        });
    }

    @Override
    public synchronized void close() {
        if (thread.isShutdown()) {
            return;
        }
        newest = null;
        interrupt();
        thread.getQueue().clear();
        thread.execute(() -> {
            release();
            pages.clear();
        });
        thread.shutdown();
    }
}
