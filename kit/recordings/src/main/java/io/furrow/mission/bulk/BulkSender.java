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
 * Sends documents in unordered bulks of upserts by {@code _id}, so that sending them again changes nothing. Collections
 * are written in parallel, each by one bulk at a time. Documents that the server rejects are found and returned, and
 * the others are written. While the server is unavailable, the remaining documents are retried. Documents with an
 * unknown error code are retried for a longer time before they count as rejected.
 */
public final class BulkSender<D extends EventDocument> implements AutoCloseable {
    private static final BulkWriteOptions UNORDERED = new BulkWriteOptions().ordered(false);
    /**
     * A server that disconnects this often at the same documents, but answers pings in between, fails because of them.
     */
    private static final int MAX_DISCONNECTS = 3;
    /** These threads mostly wait for the server; a client has at most 100 connections. */
    private static final int MAX_THREADS = 64;

    private static final int IDLE_SECONDS = 10;

    private static final ReplaceOptions UPSERT = new ReplaceOptions().upsert(true);

    private static final Logger LOG = LoggerFactory.getLogger(BulkSender.class);

    private final MissionCollections collections;
    private final MongoAccess.Waits waits;
    private final LongConsumer retried;
    /** Unknown error codes that turned out to be caused by documents: others were accepted meanwhile. */
    private final Set<Integer> documentErrorCodes = new HashSet<>();

    private final Set<Integer> loggedCodes = ConcurrentHashMap.newKeySet();
    private final ExecutorService threads = threads();

    /** @param retried called with the number of documents that are sent again */
    public BulkSender(MissionCollections collections, MongoAccess.Waits waits, LongConsumer retried) {
        this.collections = collections;
        this.waits = waits;
        this.retried = retried;
    }

    /** A document that the server rejects, and the reason. */
    public record Refusal<D extends EventDocument>(D document, String reason) {}

    /**
     * Sends documents and returns the rejected ones when all others are stored.
     *
     * @throws IOException if the server was unavailable for too long, or its settings prevent writes
     */
    public List<Refusal<D>> send(List<D> documents) throws IOException, InterruptedException {
        Map<String, List<D>> byCollection = new LinkedHashMap<>();
        for (D document : documents) {
            byCollection
                    .computeIfAbsent(document.collection(), ignored -> new ArrayList<>())
                    .add(document);
        }
        // Shared by all collections, for which a checkpoint waits together.
        UnknownErrorPolicy unknownErrorPolicy = new UnknownErrorPolicy(waits.unknown(), documentErrorCodes);
        List<Refusal<D>> rejected = send(byCollection, unknownErrorPolicy);
        checkOutcome(byCollection.keySet(), documents.size(), rejected.size(), unknownErrorPolicy);
        return rejected;
    }

    private List<Refusal<D>> send(Map<String, List<D>> byCollection, UnknownErrorPolicy unknownErrorPolicy)
            throws IOException, InterruptedException {
        if (byCollection.size() == 1) {
            List<Refusal<D>> rejected = new ArrayList<>();
            for (Map.Entry<String, List<D>> only : byCollection.entrySet()) {
                send(only.getKey(), only.getValue(), unknownErrorPolicy, rejected);
            }
            return rejected;
        }
        List<Future<List<Refusal<D>>>> answers = new ArrayList<>();
        byCollection.forEach((collection, documents) -> answers.add(threads.submit(() -> {
            List<Refusal<D>> rejected = new ArrayList<>();
            send(collection, documents, unknownErrorPolicy, rejected);
            return rejected;
        })));
        List<Refusal<D>> rejected = new ArrayList<>();
        try {
            for (Future<List<Refusal<D>>> answer : answers) {
                rejected.addAll(answer.get());
            }
            return rejected;
        } catch (ExecutionException e) {
            throw e.getCause() instanceof IOException mongoException
                    ? mongoException
                    : new IOException("documents could not be written", e.getCause());
        } finally {
            answers.forEach(answer -> answer.cancel(true));
        }
    }

    /** Throws if no document was accepted, because then the documents are not the cause, unless their codes say so. */
    private void checkOutcome(Set<String> sentTo, int documents, int rejected, UnknownErrorPolicy unknownErrorPolicy)
            throws IOException {
        if (rejected < documents) {
            documentErrorCodes.addAll(unknownErrorPolicy.givenUp());
        } else if (documents > 1 && !documentErrorCodes.containsAll(unknownErrorPolicy.givenUp())) {
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
            String collection, List<D> documents, UnknownErrorPolicy unknownErrorPolicy, List<Refusal<D>> rejected)
            throws IOException, InterruptedException {
        RetryTimer retryTimer = new RetryTimer(waits.unavailable());
        List<D> remaining = documents;
        int disconnects = 0;
        while (!remaining.isEmpty()) {
            boolean prepared = false;
            try {
                MongoCollection<RawBsonDocument> target = collections.prepared(collection);
                prepared = true;
                target.bulkWrite(upserts(remaining), UNORDERED);
                return;
            } catch (MongoBulkWriteException e) {
                BulkResponse<D> bulkResponse = read(e, remaining, unknownErrorPolicy, rejected);
                boolean progressed = bulkResponse.remaining().size() < remaining.size();
                remaining = bulkResponse.remaining();
                if (!remaining.isEmpty()) {
                    pause(bulkResponse.isUnavailable() && !progressed, retryTimer, e);
                }
            } catch (MongoInterruptedException e) {
                throw (InterruptedException) new InterruptedException(e.getMessage()).initCause(e);
            } catch (MongoException | BsonSerializationException | BsonInvalidOperationException e) {
                disconnects += e instanceof MongoSocketException && collections.serverAnswers() ? 1 : 0;
                // Otherwise the creation of an index failed; another writer may be creating it now.
                MongoFailure failure =
                        prepared ? failure(e, collection, unknownErrorPolicy, remaining.size()) : failureToPrepare(e);
                if (failure == MongoFailure.REJECTED || prepared && disconnects == MAX_DISCONNECTS) {
                    findRejected(collection, remaining, e, unknownErrorPolicy, rejected);
                    return;
                }
                pause(failure == MongoFailure.UNAVAILABLE, retryTimer, e);
            }
            countRetried(remaining.size());
        }
    }

    private synchronized void countRetried(int documents) {
        retried.accept(documents);
    }

    private static void pause(boolean isUnavailable, RetryTimer retryTimer, Exception why)
            throws IOException, InterruptedException {
        if (isUnavailable) {
            retryTimer.pauseAfter(why);
        } else {
            retryTimer.pauseAndResetTimeout();
        }
    }

    private static MongoFailure failureToPrepare(Exception e) throws IOException {
        if (e instanceof MongoException mongoException && MongoFailure.of(mongoException) == MongoFailure.SETTING) {
            throw wrongSetting(e);
        }
        return MongoFailure.UNAVAILABLE;
    }

    /** Returns the failure of a whole command; documents with an unknown code are rejected after a timeout. */
    private MongoFailure failure(Exception e, String collection, UnknownErrorPolicy unknownErrorPolicy, int documents)
            throws IOException {
        if (!(e instanceof MongoException mongoException)) {
            return MongoFailure.REJECTED; // the driver cannot encode a document
        }
        MongoFailure failure = MongoFailure.of(mongoException);
        if (failure == MongoFailure.SETTING) {
            throw wrongSetting(e);
        }
        boolean ofCommand =
                failure == MongoFailure.REJECTED && MongoCodes.isAmbiguousForCommand(mongoException.getCode());
        if (failure != MongoFailure.UNKNOWN && !ofCommand) {
            return failure;
        }
        countUnknownError(collection, mongoException.getCode(), mongoException.getMessage(), unknownErrorPolicy);
        if (!unknownErrorPolicy.isExhausted(collection, mongoException.getCode())) {
            return MongoFailure.UNKNOWN;
        }
        if (documents == 1) {
            unknownErrorPolicy.giveUp(mongoException.getCode());
        }
        return MongoFailure.REJECTED;
    }

    /** Sends halves of a rejected bulk until the rejected document stands alone. */
    private void findRejected(
            String collection,
            List<D> documents,
            Exception why,
            UnknownErrorPolicy unknownErrorPolicy,
            List<Refusal<D>> rejected)
            throws IOException, InterruptedException {
        if (documents.size() == 1) {
            rejected.add(new Refusal<>(documents.get(0), why.getMessage()));
            return;
        }
        int half = documents.size() / 2;
        send(collection, documents.subList(0, half), unknownErrorPolicy, rejected);
        send(collection, documents.subList(half, documents.size()), unknownErrorPolicy, rejected);
    }

    /**
     * The outcome of a bulk.
     *
     * @param remaining documents to retry
     * @param isUnavailable whether some have to be retried because the server is unavailable
     */
    private record BulkResponse<D>(List<D> remaining, boolean isUnavailable) {}

    /** Reads the errors of a bulk; if the write concern was not met, all documents are retried. */
    private BulkResponse<D> read(
            MongoBulkWriteException e, List<D> sent, UnknownErrorPolicy unknownErrorPolicy, List<Refusal<D>> rejected)
            throws IOException {
        boolean unconfirmed = e.getWriteConcernError() != null;
        boolean unavailable = unconfirmed;
        boolean counted = false;
        List<D> remaining = new ArrayList<>(unconfirmed ? sent : List.of());
        for (BulkWriteError error : e.getWriteErrors()) {
            D document = sent.get(error.getIndex());
            MongoFailure failure = MongoFailure.of(error.getCode(), error.getMessage());
            if (failure == MongoFailure.SETTING) {
                throw wrongSetting(e);
            }
            if (failure == MongoFailure.UNKNOWN && !counted) {
                counted = true; // once per bulk
                countUnknownError(document.collection(), error.getCode(), error.getMessage(), unknownErrorPolicy);
            }
            boolean givenUp = failure == MongoFailure.UNKNOWN
                    && unknownErrorPolicy.isExhausted(document.collection(), error.getCode());
            if (givenUp) {
                unknownErrorPolicy.giveUp(error.getCode());
            }
            if (givenUp || failure == MongoFailure.REJECTED) {
                rejected.add(new Refusal<>(document, error.getMessage()));
                remaining.remove(document);
            } else {
                unavailable |= failure == MongoFailure.UNAVAILABLE;
                if (!unconfirmed) {
                    remaining.add(document);
                }
            }
        }
        return new BulkResponse<>(remaining, unavailable);
    }

    private void countUnknownError(String collection, int code, String message, UnknownErrorPolicy unknownErrorPolicy) {
        unknownErrorPolicy.failed(collection);
        if (loggedCodes.add(code)) {
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
