package io.furrow.ingest.mission;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
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

/**
 * Sends documents in unordered bulks of upserts by {@code _id}: sent again they change nothing. What the server refuses is
 * found and given back, the rest is written; while the server is away the rest is tried again.
 */
final class BulkSender {
    private static final BulkWriteOptions UNORDERED = new BulkWriteOptions().ordered(false);
    /** A server that breaks off as often at the same documents, and answers in between, does so because of them. */
    private static final int BREAKS = 3;

    private static final ReplaceOptions UPSERT = new ReplaceOptions().upsert(true);

    private final MissionCollections collections;
    private final Duration patience;
    private final LongConsumer retried;

    /** @param retried is told how many documents are sent once more */
    BulkSender(MissionCollections collections, Duration patience, LongConsumer retried) {
        this.collections = collections;
        this.patience = patience;
        this.retried = retried;
    }

    /** A document that the server does not take, and why. */
    record Refusal(MissionDocument document, String reason) {}

    /**
     * Returns when the server has every document that it takes.
     *
     * @throws IOException if it was away too long, or takes nothing under these settings
     */
    List<Refusal> send(List<MissionDocument> documents) throws IOException, InterruptedException {
        Map<String, List<MissionDocument>> byCollection = new LinkedHashMap<>();
        for (MissionDocument document : documents) {
            byCollection
                    .computeIfAbsent(document.collection(), ignored -> new ArrayList<>())
                    .add(document);
        }
        List<Refusal> refused = new ArrayList<>();
        for (Map.Entry<String, List<MissionDocument>> part : byCollection.entrySet()) {
            send(part.getKey(), part.getValue(), refused);
        }
        return refused;
    }

    private void send(String collection, List<MissionDocument> documents, List<Refusal> refused)
            throws IOException, InterruptedException {
        Patience left = new Patience(patience);
        List<MissionDocument> open = documents;
        int breaks = 0;
        while (!open.isEmpty()) {
            boolean prepared = false;
            try {
                MongoCollection<RawBsonDocument> target = collections.prepared(collection);
                prepared = true;
                target.bulkWrite(upserts(open), UNORDERED);
                return;
            } catch (MongoBulkWriteException e) {
                open = notWritten(e, open, refused);
                if (!open.isEmpty()) {
                    left.pauseAfter(e);
                }
            } catch (MongoInterruptedException e) {
                throw (InterruptedException) new InterruptedException(e.getMessage()).initCause(e);
            } catch (MongoException | BsonSerializationException | BsonInvalidOperationException e) {
                MongoFailure failure =
                        e instanceof MongoException known ? MongoFailure.of(known) : MongoFailure.REFUSED;
                if (failure == MongoFailure.SETTING) {
                    throw wrongSetting(e);
                }
                breaks += e instanceof MongoSocketException && collections.serverAnswers() ? 1 : 0;
                // What is refused before is the making of indexes: another writer may be making them at this moment.
                if (prepared && (failure == MongoFailure.REFUSED || breaks == BREAKS)) {
                    findRefused(collection, open, e, refused);
                    return;
                }
                left.pauseAfter(e);
            }
            retried.accept(open.size());
        }
    }

    /** One of several was refused, and with it all: halves are tried until it stands alone. */
    private void findRefused(String collection, List<MissionDocument> documents, Exception why, List<Refusal> refused)
            throws IOException, InterruptedException {
        if (documents.size() == 1) {
            refused.add(new Refusal(documents.get(0), why.getMessage()));
            return;
        }
        int half = documents.size() / 2;
        send(collection, documents.subList(0, half), refused);
        send(collection, documents.subList(half, documents.size()), refused);
    }

    /** What is worth another attempt; all of it where the write concern was not met. */
    private static List<MissionDocument> notWritten(
            MongoBulkWriteException e, List<MissionDocument> sent, List<Refusal> refused) throws IOException {
        boolean unsure = e.getWriteConcernError() != null;
        List<MissionDocument> open = new ArrayList<>(unsure ? sent : List.of());
        for (BulkWriteError error : e.getWriteErrors()) {
            MissionDocument document = sent.get(error.getIndex());
            switch (MongoFailure.of(error.getCode(), error.getMessage())) {
                case SETTING -> throw wrongSetting(e);
                case REFUSED -> {
                    refused.add(new Refusal(document, error.getMessage()));
                    open.remove(document);
                }
                case AWAY -> {
                    if (!unsure) {
                        open.add(document);
                    }
                }
            }
        }
        return open;
    }

    private static IOException wrongSetting(Exception e) {
        return new IOException(
                "MongoDB refuses to take any document: %s. Check the user, the database and what --mongo says."
                        .formatted(e.getMessage()),
                e);
    }

    private static List<WriteModel<RawBsonDocument>> upserts(List<MissionDocument> documents) {
        List<WriteModel<RawBsonDocument>> upserts = new ArrayList<>(documents.size());
        for (MissionDocument document : documents) {
            upserts.add(new ReplaceOneModel<>(
                    Filters.eq(DocumentForm.ID, document.id()), new RawBsonDocument(document.bson()), UPSERT));
        }
        return upserts;
    }
}
