package io.furrow.ingest.mission;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.IdentityHashMap;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;

import org.apache.flink.api.connector.sink2.SinkWriter;
import org.apache.flink.metrics.groups.SinkWriterMetricGroup;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.bulk.BulkSender;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Collects documents into bulks; the next bulk is collected while one is in flight, and sent before it is full, so that little
 * is left at a checkpoint. A checkpoint waits until all earlier documents are written, or were refused and have their dead
 * letters.
 */
@SuppressWarnings("try") // close() may be interrupted, as a sink writer's may
final class MissionWriter implements SinkWriter<MissionDocument> {
    private static final int MAX_DOCUMENTS = 1_000;
    private static final int MAX_BYTES = 8 * 1024 * 1024;
    /** Age of the oldest document at which a bulk is sent to an idle server, which syncs its disk for each bulk. */
    private static final long GATHERING_NANOS = Duration.ofSeconds(1).toNanos();
    /** Number of documents likewise: the work of larger bulks delays the events of that moment. */
    private static final int GATHERED_DOCUMENTS = 128;

    private final BulkSender<MissionDocument> sender;
    private final SinkWriter<TopicRecord> deadLetters;
    private final AutoCloseable connection;
    private final ExecutorService thread = Executors.newSingleThreadExecutor(MissionWriter::named);
    private final DocumentCounters documents;
    private final SinkWriterMetricGroup metrics;

    private List<MissionDocument> gathered = new ArrayList<>();
    private long gatheredBytes;
    private long gatheredSince;
    private List<MissionDocument> sent = List.of();
    private Future<List<BulkSender.Refusal<MissionDocument>>> underWay = CompletableFuture.completedFuture(List.of());

    /** @param connection closed with the writer */
    MissionWriter(
            BulkSender<MissionDocument> sender,
            SinkWriter<TopicRecord> deadLetters,
            AutoCloseable connection,
            SinkWriterMetricGroup metrics) {
        this.sender = sender;
        this.deadLetters = deadLetters;
        this.connection = connection;
        this.metrics = metrics;
        this.documents = new DocumentCounters(metrics);
    }

    @Override
    public void write(MissionDocument document, Context context) throws IOException, InterruptedException {
        if (gathered.isEmpty()) {
            gatheredSince = System.nanoTime();
        }
        gathered.add(document);
        gatheredBytes += document.bson().length;
        boolean full = gathered.size() >= MAX_DOCUMENTS || gatheredBytes >= MAX_BYTES;
        boolean due = gathered.size() >= GATHERED_DOCUMENTS || System.nanoTime() - gatheredSince >= GATHERING_NANOS;
        if (full || due && underWay.isDone()) {
            sendGathered();
        }
    }

    @Override
    public void flush(boolean endOfInput) throws IOException, InterruptedException {
        sendGathered();
        awaitUnderWay();
        deadLetters.flush(endOfInput);
    }

    private void sendGathered() throws IOException, InterruptedException {
        awaitUnderWay();
        List<MissionDocument> bulk = gathered;
        if (bulk.isEmpty()) {
            return;
        }
        metrics.getNumRecordsSendCounter().inc(bulk.size());
        metrics.getNumBytesSendCounter().inc(gatheredBytes);
        gathered = new ArrayList<>();
        gatheredBytes = 0;
        sent = bulk;
        underWay = thread.submit(() -> sender.send(bulk));
    }

    private void awaitUnderWay() throws IOException, InterruptedException {
        Future<List<BulkSender.Refusal<MissionDocument>>> answer = underWay;
        List<MissionDocument> bulk = sent;
        underWay = CompletableFuture.completedFuture(List.of());
        sent = List.of();
        try {
            List<BulkSender.Refusal<MissionDocument>> refused = answer.get();
            Set<MissionDocument> notWritten = Collections.newSetFromMap(new IdentityHashMap<>());
            for (BulkSender.Refusal<MissionDocument> refusal : refused) {
                notWritten.add(refusal.document());
                setAside(refusal);
            }
            for (MissionDocument document : bulk) {
                if (!notWritten.contains(document)) {
                    documents.written(document);
                }
            }
        } catch (ExecutionException e) {
            throw e.getCause() instanceof IOException known
                    ? known
                    : new IOException("documents could not be written", e.getCause());
        }
    }

    private void setAside(BulkSender.Refusal<MissionDocument> refusal) throws IOException, InterruptedException {
        documents.refused(refusal.document());
        UnreadableException why = new UnreadableException(Reason.REFUSED, refusal.reason());
        TopicRecord record = refusal.document().event().record();
        deadLetters.write(DeadLetters.of(record, why, ComposeDocuments.STAGE), NO_CONTEXT);
    }

    @Override
    public void close() throws Exception {
        thread.shutdownNow();
        sender.close();
        try {
            deadLetters.close();
        } finally {
            connection.close();
        }
    }

    private static Thread named(Runnable work) {
        Thread thread = new Thread(work, "missions to MongoDB");
        thread.setDaemon(true);
        return thread;
    }

    /** A dead letter has its own time. */
    private static final Context NO_CONTEXT = new Context() {
        @Override
        public long currentWatermark() {
            return Long.MIN_VALUE;
        }

        @Override
        public Long timestamp() {
            return null;
        }
    };
}
