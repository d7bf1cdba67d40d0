package io.furrow.mission.bulk;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Future;
import java.util.concurrent.SynchronousQueue;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import java.util.function.LongConsumer;

import com.mongodb.MongoBulkWriteException;
import com.mongodb.MongoException;
import com.mongodb.MongoInterruptedException;
import com.mongodb.MongoSocketException;
import com.mongodb.bulk.BulkWriteError;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.BulkWriteOptions;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.ReplaceOneModel;
import com.mongodb.client.model.ReplaceOptions;
import com.mongodb.client.model.WriteModel;
import org.bson.BsonInvalidOperationException;
import org.bson.BsonSerializationException;
import org.bson.RawBsonDocument;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;

/**
 * Sends documents in unordered bulks of upserts by {@code _id}: sent again they change nothing. Collections are written side by
 * side, each by one bulk at a time. What the server refuses is
 * found and given back, the rest is written; while the server is unavailable the rest is tried again. What it does not take for a
 * reason that is not known to be the document's is tried again for long, before it counts as refused.
 */
public final class BulkSender<D extends EventDocument> implements AutoCloseable {
    private static final BulkWriteOptions UNORDERED = new BulkWriteOptions().ordered(false);
    /** A server that breaks off as often at the same documents, and answers in between, does so because of them. */
    private static final int BREAKS = 3;
    /** Most of their time these threads wait for the server; a client has at most 100 connections. */
    private static final int MAX_THREADS = 64;

    private static final int IDLE_SECONDS = 10;

    private static final ReplaceOptions UPSERT = new ReplaceOptions().upsert(true);

    private static final Logger LOG = LoggerFactory.getLogger(BulkSender.class);

    private final MissionCollections collections;
    private final MongoAccess.Waits waits;
    private final LongConsumer retried;
    /** Codes of which documents were given up while others were taken. */
    private final Set<Integer> learned = new HashSet<>();

    private final Set<Integer> doubted = ConcurrentHashMap.newKeySet();
    private final ExecutorService threads = threads();

    /** @param retried is called with how many documents are sent once more */
    public BulkSender(MissionCollections collections, MongoAccess.Waits waits, LongConsumer retried) {
        this.collections = collections;
        this.waits = waits;
        this.retried = retried;
    }

    /** A document that the server does not take, and why. */
    public record Refusal<D extends EventDocument>(D document, String reason) {}

    /**
     * Returns when the server has every document that it takes.
     *
     * @throws IOException if it was unavailable too long, or takes nothing under these settings
     */
    public List<Refusal<D>> send(List<D> documents) throws IOException, InterruptedException {
        Map<String, List<D>> byCollection = new LinkedHashMap<>();
        for (D document : documents) {
            byCollection
                    .computeIfAbsent(document.collection(), ignored -> new ArrayList<>())
                    .add(document);
        }
        UnknownErrorPolicy unknownErrorPolicy =
                new UnknownErrorPolicy(waits.unknown(), learned); // one for all: a checkpoint waits for them together
        List<Refusal<D>> refused = send(byCollection, unknownErrorPolicy);
        judge(byCollection.keySet(), documents.size(), refused.size(), unknownErrorPolicy);
        return refused;
    }

    private List<Refusal<D>> send(Map<String, List<D>> byCollection, UnknownErrorPolicy unknownErrorPolicy)
            throws IOException, InterruptedException {
        if (byCollection.size() == 1) {
            List<Refusal<D>> refused = new ArrayList<>();
            for (Map.Entry<String, List<D>> only : byCollection.entrySet()) {
                send(only.getKey(), only.getValue(), unknownErrorPolicy, refused);
            }
            return refused;
        }
        List<Future<List<Refusal<D>>>> answers = new ArrayList<>();
        byCollection.forEach((collection, documents) -> answers.add(threads.submit(() -> {
            List<Refusal<D>> refused = new ArrayList<>();
            send(collection, documents, unknownErrorPolicy, refused);
            return refused;
        })));
        List<Refusal<D>> refused = new ArrayList<>();
        try {
            for (Future<List<Refusal<D>>> answer : answers) {
                refused.addAll(answer.get());
            }
            return refused;
        } catch (ExecutionException e) {
            throw e.getCause() instanceof IOException known
                    ? known
                    : new IOException("documents could not be written", e.getCause());
        } finally {
            answers.forEach(answer -> answer.cancel(true));
        }
    }

    /** Where none at all was taken, no document is at fault, unless its code is known for that. */
    private void judge(Set<String> sentTo, int documents, int refused, UnknownErrorPolicy unknownErrorPolicy)
            throws IOException {
        if (refused < documents) {
            learned.addAll(unknownErrorPolicy.givenUp());
        } else if (documents > 1 && !learned.containsAll(unknownErrorPolicy.givenUp())) {
            throw new IOException(
                    "MongoDB took none of %d documents of %s for %d s, codes %s. Look into its log; see --mongo-refusal-timeout."
                            .formatted(
                                    documents,
                                    String.join(", ", sentTo),
                                    waits.unknown().toSeconds(),
                                    unknownErrorPolicy.givenUp()));
        }
    }

    private void send(
            String collection, List<D> documents, UnknownErrorPolicy unknownErrorPolicy, List<Refusal<D>> refused)
            throws IOException, InterruptedException {
        RetryTimer left = new RetryTimer(waits.away());
        List<D> open = documents;
        int breaks = 0;
        while (!open.isEmpty()) {
            boolean prepared = false;
            try {
                MongoCollection<RawBsonDocument> target = collections.prepared(collection);
                prepared = true;
                target.bulkWrite(upserts(open), UNORDERED);
                return;
            } catch (MongoBulkWriteException e) {
                BulkResponse<D> bulkResponse = read(e, open, unknownErrorPolicy, refused);
                boolean progressed = bulkResponse.open().size() < open.size();
                open = bulkResponse.open();
                if (!open.isEmpty()) {
                    pause(bulkResponse.isAway() && !progressed, left, e);
                }
            } catch (MongoInterruptedException e) {
                throw (InterruptedException) new InterruptedException(e.getMessage()).initCause(e);
            } catch (MongoException | BsonSerializationException | BsonInvalidOperationException e) {
                breaks += e instanceof MongoSocketException && collections.serverAnswers() ? 1 : 0;
                // What fails before is the making of indexes: another writer may be making them at this moment.
                MongoFailure failure =
                        prepared ? failure(e, collection, unknownErrorPolicy, open.size()) : failureToPrepare(e);
                if (failure == MongoFailure.REFUSED || prepared && breaks == BREAKS) {
                    findRefused(collection, open, e, unknownErrorPolicy, refused);
                    return;
                }
                pause(failure == MongoFailure.UNAVAILABLE, left, e);
            }
            countRetried(open.size());
        }
    }

    private synchronized void countRetried(int documents) {
        retried.accept(documents);
    }

    private static void pause(boolean isAway, RetryTimer left, Exception why) throws IOException, InterruptedException {
        if (isAway) {
            left.pauseAfter(why);
        } else {
            left.pauseOfOneThatAnswers();
        }
    }

    private static MongoFailure failureToPrepare(Exception e) throws IOException {
        if (e instanceof MongoException known && MongoFailure.of(known) == MongoFailure.SETTING) {
            throw wrongSetting(e);
        }
        return MongoFailure.UNAVAILABLE;
    }

    /** Of all documents together; what is in doubt long enough is refused. */
    private MongoFailure failure(Exception e, String collection, UnknownErrorPolicy unknownErrorPolicy, int documents)
            throws IOException {
        if (!(e instanceof MongoException known)) {
            return MongoFailure.REFUSED; // the driver found that it is not a document
        }
        MongoFailure failure = MongoFailure.of(known);
        if (failure == MongoFailure.SETTING) {
            throw wrongSetting(e);
        }
        boolean ofCommand = failure == MongoFailure.REFUSED && MongoCodes.mayBeOfTheCommand(known.getCode());
        if (failure != MongoFailure.UNKNOWN && !ofCommand) {
            return failure;
        }
        judgeUnknownError(collection, known.getCode(), known.getMessage(), unknownErrorPolicy);
        if (!unknownErrorPolicy.isOver(collection, known.getCode())) {
            return MongoFailure.UNKNOWN;
        }
        if (documents == 1) {
            unknownErrorPolicy.giveUp(known.getCode());
        }
        return MongoFailure.REFUSED;
    }

    /** One of several was refused, and with it all: halves are tried until it stands alone. */
    private void findRefused(
            String collection,
            List<D> documents,
            Exception why,
            UnknownErrorPolicy unknownErrorPolicy,
            List<Refusal<D>> refused)
            throws IOException, InterruptedException {
        if (documents.size() == 1) {
            refused.add(new Refusal<>(documents.get(0), why.getMessage()));
            return;
        }
        int half = documents.size() / 2;
        send(collection, documents.subList(0, half), unknownErrorPolicy, refused);
        send(collection, documents.subList(half, documents.size()), unknownErrorPolicy, refused);
    }

    /**
     * What an answer leaves.
     *
     * @param open worth another attempt
     * @param isAway whether some of it is so because the server is unavailable
     */
    private record BulkResponse<D>(List<D> open, boolean isAway) {}

    /** Where the write concern was not met, all is worth another attempt. */
    private BulkResponse<D> read(
            MongoBulkWriteException e, List<D> sent, UnknownErrorPolicy unknownErrorPolicy, List<Refusal<D>> refused)
            throws IOException {
        boolean unsure = e.getWriteConcernError() != null;
        boolean away = unsure;
        boolean attempted = false;
        List<D> open = new ArrayList<>(unsure ? sent : List.of());
        for (BulkWriteError error : e.getWriteErrors()) {
            D document = sent.get(error.getIndex());
            MongoFailure failure = MongoFailure.of(error.getCode(), error.getMessage());
            if (failure == MongoFailure.SETTING) {
                throw wrongSetting(e);
            }
            if (failure == MongoFailure.UNKNOWN && !attempted) {
                attempted = true; // however many documents it fails for
                judgeUnknownError(document.collection(), error.getCode(), error.getMessage(), unknownErrorPolicy);
            }
            boolean givenUp = failure == MongoFailure.UNKNOWN
                    && unknownErrorPolicy.isOver(document.collection(), error.getCode());
            if (givenUp) {
                unknownErrorPolicy.giveUp(error.getCode());
            }
            if (givenUp || failure == MongoFailure.REFUSED) {
                refused.add(new Refusal<>(document, error.getMessage()));
                open.remove(document);
            } else {
                away |= failure == MongoFailure.UNAVAILABLE;
                if (!unsure) {
                    open.add(document);
                }
            }
        }
        return new BulkResponse<>(open, away);
    }

    private void judgeUnknownError(String collection, int code, String message, UnknownErrorPolicy unknownErrorPolicy) {
        unknownErrorPolicy.failed(collection);
        if (doubted.add(code)) {
            LOG.warn(
                    "MongoDB does not accept documents, code {}: {}. They are retried for {} s, then become dead letters",
                    code,
                    message,
                    waits.unknown().toSeconds());
        }
    }

    private static IOException wrongSetting(Exception e) {
        return new IOException(
                "MongoDB refuses to take any document: %s. Check the user, the database and what --mongo says."
                        .formatted(e.getMessage()),
                e);
    }

    private static List<WriteModel<RawBsonDocument>> upserts(List<? extends EventDocument> documents) {
        List<WriteModel<RawBsonDocument>> upserts = new ArrayList<>(documents.size());
        for (EventDocument document : documents) {
            upserts.add(new ReplaceOneModel<>(
                    Filters.eq(EventDocumentCodec.ID, document.id()), new RawBsonDocument(document.bson()), UPSERT));
        }
        return upserts;
    }

    private static ExecutorService threads() {
        return new ThreadPoolExecutor(
                0,
                MAX_THREADS,
                IDLE_SECONDS,
                TimeUnit.SECONDS,
                new SynchronousQueue<>(),
                work -> {
                    Thread thread = new Thread(work, "missions to MongoDB");
                    thread.setDaemon(true);
                    return thread;
                },
                (work, allBusy) -> work.run());
    }

    @Override
    public void close() {
        threads.shutdownNow();
    }
}
