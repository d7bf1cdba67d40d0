package io.furrow.ingest.image;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.RejectedExecutionException;

import org.apache.flink.api.common.operators.MailboxExecutor;
import org.apache.flink.api.common.state.ListState;
import org.apache.flink.api.common.state.ListStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.runtime.state.StateSnapshotContext;
import org.apache.flink.runtime.state.VoidNamespace;
import org.apache.flink.runtime.state.VoidNamespaceSerializer;
import org.apache.flink.streaming.api.operators.AbstractStreamOperator;
import org.apache.flink.streaming.api.operators.OneInputStreamOperator;
import org.apache.flink.streaming.api.operators.StreamOperatorParameters;
import org.apache.flink.streaming.api.watermark.Watermark;
import org.apache.flink.streaming.runtime.streamrecord.StreamRecord;
import org.apache.flink.streaming.runtime.watermarkstatus.WatermarkStatus;
import org.apache.flink.util.function.ThrowingRunnable;

import io.furrow.flink.record.DeadLetters;
import io.furrow.ingest.route.ReportedEvent;

/**
 * Writes images in its own threads while other entities' events pass; keyed by entity, whose events stay in order. One image
 * of an entity is written at a time. Watermarks wait for the events before them.
 *
 * <p>State: events that wait for the store, per entity, written at a checkpoint. Cleared: when the entity's last one was
 * emitted. Late: no difference. Emits: each event once, its images replaced; the manifest and dead letters as side outputs.
 */
final class MoveImages extends AbstractStreamOperator<ReportedEvent>
        implements OneInputStreamOperator<ReportedEvent, ReportedEvent> {
    private static final long serialVersionUID = 1L;
    private static final String STATE = "in-flight";
    /** Approximate size of an event besides its value. */
    private static final int OVERHEAD_BYTES = 512;
    /** Grace time after the timeout for an attempt without an answer; then the job fails. */
    private static final Duration HANGING = Duration.ofMinutes(1);

    private final ImageSettings settings;
    private final TypeInformation<ReportedEvent> type;
    private final transient MailboxExecutor mailbox;
    private transient ImageMover mover;
    private transient ImageCounts counts;
    private transient ExecutorService threads;
    private transient ListState<ReportedEvent> inFlight;
    private transient Set<String> kept;
    private transient Map<String, Deque<InFlightEvent>> byEntity;
    private transient Deque<InFlightEvent> inOrder;
    private transient long bytes;

    /** @param settings null if images stay in the events */
    MoveImages(
            StreamOperatorParameters<ReportedEvent> parameters,
            ImageSettings settings,
            TypeInformation<ReportedEvent> type,
            MailboxExecutor mailbox) {
        super(parameters);
        this.settings = settings;
        this.type = type;
        this.mailbox = mailbox;
    }

    @Override
    public void open() throws Exception {
        super.open();
        counts = new ImageCounts(getMetricGroup(), () -> bytes);
        if (settings != null) {
            mover = new ImageMover(settings, ImageStore.of(settings));
            threads = Executors.newFixedThreadPool(settings.threads(), MoveImages::thread);
        }
        byEntity = new HashMap<>();
        inOrder = new ArrayDeque<>();
        inFlight = getPartitionedState(
                VoidNamespace.INSTANCE, VoidNamespaceSerializer.INSTANCE, new ListStateDescriptor<>(STATE, type));
        try (var entities = getKeyedStateBackend().getKeys(STATE, VoidNamespace.INSTANCE)) {
            kept = new HashSet<>(entities.map(String.class::cast).toList());
        }
        for (String entity : List.copyOf(kept)) {
            setCurrentKey(entity);
            for (ReportedEvent event : inFlight.get()) {
                add(event);
            }
        }
    }

    private static Thread thread(Runnable task) {
        Thread thread = new Thread(task, "images");
        thread.setDaemon(true); // a hanging store must not prevent the end of the process
        return thread;
    }

    @Override
    public void processElement(StreamRecord<ReportedEvent> element) throws Exception {
        ReportedEvent event = element.getValue();
        if (!isConcerned(event) && !byEntity.containsKey(event.identity())) {
            output.collect(element);
            return;
        }
        long size = size(event);
        while (bytes + size > settings.maxInFlightBytes() && !byEntity.isEmpty()) {
            mailbox.yield();
        }
        add(event);
    }

    private void add(ReportedEvent event) throws Exception {
        InFlightEvent inFlightEvent = InFlightEvent.event(event);
        Deque<InFlightEvent> queue = byEntity.computeIfAbsent(event.identity(), entity -> new ArrayDeque<>());
        queue.add(inFlightEvent);
        inOrder.add(inFlightEvent);
        bytes += size(event);
        if (queue.size() == 1) {
            begin(inFlightEvent);
        }
    }

    /** Passes the first event of an entity to a thread; one without images is emitted by the next mail. */
    private void begin(InFlightEvent inFlightEvent) {
        ReportedEvent event = inFlightEvent.event();
        if (!isConcerned(event)) {
            mailbox.execute(() -> goOn(inFlightEvent, MoveResult.unannounced(event.record())), "pass an event");
            return;
        }
        StoreRetries attempts = new StoreRetries(mover, settings.timeout(), counts::retried);
        threads.execute(() -> {
            send(() -> expectAnswer(inFlightEvent));
            try {
                MoveResult moveResult = attempts.move(event);
                send(() -> goOn(inFlightEvent, moveResult));
            } catch (IOException | RuntimeException | LinkageError e) { // the last: a store's client lacks a class
                send(() -> fail(event, e));
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt(); // the task is being closed
            }
        });
    }

    /** The timeout of an image begins when a thread takes it: the wait for a thread is not the store's fault. */
    private void expectAnswer(InFlightEvent inFlightEvent) {
        long deadline = getProcessingTimeService().getCurrentProcessingTime()
                + settings.timeout().plus(HANGING).toMillis();
        inFlightEvent.until(getProcessingTimeService()
                .registerTimer(
                        deadline, time -> fail(inFlightEvent.event(), new IOException("the store does not answer"))));
    }

    /** Runs an action on the task's own thread. */
    private void send(ThrowingRunnable<Exception> mail) {
        try {
            mailbox.execute(mail, "go on after storing an image");
        } catch (RejectedExecutionException e) {
            LOG.debug("The task was closed while an image was stored", e);
        }
    }

    private void fail(ReportedEvent event, Throwable cause) throws IOException {
        throw new IOException(
                "the image of " + event.identity() + " at " + event.record().position() + " could not be stored below "
                        + settings.root() + "; the job is restarted",
                cause);
    }

    private void goOn(InFlightEvent done, MoveResult moveResult) throws Exception {
        ReportedEvent event = done.event();
        output.collect(
                new StreamRecord<>(event.as(moveResult.record()), event.record().timestamp()));
        moveResult
                .manifest()
                .forEach(record -> output.collect(
                        ImageStage.MANIFEST,
                        new StreamRecord<>(record, event.record().timestamp())));
        moveResult
                .deadLetters()
                .forEach(record -> output.collect(
                        DeadLetters.TAG,
                        new StreamRecord<>(record, event.record().timestamp())));
        counts.count(event, moveResult);
        bytes -= size(event);
        done.pass();
        Deque<InFlightEvent> queue = byEntity.get(event.identity());
        queue.remove();
        if (!queue.isEmpty()) {
            begin(queue.element());
        } else {
            byEntity.remove(event.identity());
            forget(event.identity());
        }
        while (!inOrder.isEmpty() && inOrder.element().hasPassed()) {
            inOrder.remove().emitMark();
        }
    }

    private void forget(String entity) {
        if (kept.remove(entity)) {
            setCurrentKey(entity);
            inFlight.clear();
        }
    }

    @Override
    public void processWatermark(Watermark mark) throws Exception {
        if (inOrder.isEmpty()) {
            super.processWatermark(mark);
        } else {
            inOrder.add(InFlightEvent.mark(() -> super.processWatermark(mark)));
        }
    }

    @Override
    public void processWatermarkStatus(WatermarkStatus status) throws Exception {
        if (inOrder.isEmpty()) {
            super.processWatermarkStatus(status);
        } else {
            inOrder.add(InFlightEvent.mark(() -> super.processWatermarkStatus(status)));
        }
    }

    @Override
    public void snapshotState(StateSnapshotContext context) throws Exception {
        super.snapshotState(context);
        for (Map.Entry<String, Deque<InFlightEvent>> waiting : byEntity.entrySet()) {
            setCurrentKey(waiting.getKey());
            List<ReportedEvent> events = new ArrayList<>();
            waiting.getValue().forEach(one -> events.add(one.event()));
            inFlight.update(events);
            kept.add(waiting.getKey());
        }
    }

    /** At the end of the input, waiting events must be emitted before the task may finish. */
    @Override
    public void finish() throws Exception {
        while (!byEntity.isEmpty()) {
            mailbox.yield();
        }
        super.finish();
    }

    @Override
    public void close() throws Exception {
        if (threads != null) {
            threads.shutdownNow();
        }
        super.close();
    }

    private boolean isConcerned(ReportedEvent event) {
        return mover != null && mover.concerns(event.record());
    }

    boolean isIdle() {
        return byEntity.isEmpty() && inOrder.isEmpty() && bytes == 0;
    }

    long bytesInFlight() {
        return bytes;
    }

    private long size(ReportedEvent event) {
        byte[] value = event.record().value();
        return OVERHEAD_BYTES + (value == null ? 0 : value.length);
    }
}
