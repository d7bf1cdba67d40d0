package io.furrow.mission.archive;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.InputStream;
import java.io.InputStreamReader;
import java.io.OutputStream;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.function.LongConsumer;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Sorts;
import org.bson.RawBsonDocument;

import io.furrow.mission.EventOrder;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.bulk.BulkSender;
import io.furrow.mission.bulk.EventDocument;
import io.furrow.mission.file.ArchiveLine;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.ngsi.UnreadableException;

/** Lists, exports and imports the missions that are stored in MongoDB. */
public final class StoredMissions implements MissionFiles.Importer, AutoCloseable {
    private static final int BATCH = 1_000;
    private static final int BATCH_BYTES = 8 << 20;
    private static final int REPORT_INTERVAL = 10_000;
    private static final MongoAccess.Waits WAITS = MongoAccess.Waits.of(Duration.ofSeconds(20));

    private final MongoClient client;
    private final MissionCollections collections;

    private StoredMissions(MongoClient client) {
        this.client = client;
        this.collections = new MissionCollections(client, null, Clock.systemUTC());
    }

    /**
     * @param uri of MongoDB
     * @throws IllegalArgumentException if the URI is invalid
     */
    public static StoredMissions open(String uri) {
        return new StoredMissions(new MongoAccess(uri, WAITS).open());
    }

    /**
     * Describes a stored mission.
     *
     * @param mission its name; the hash in the collection's name if no event contains the name
     * @param collection its collection in MongoDB
     * @param bytes size of the documents without indexes; −1 if the server does not report it
     * @param first event time of the oldest event
     * @param last event time of the newest event
     * @param indexes names of the indexes
     * @param retention how long the server keeps documents; null if it does not expire them
     */
    public record Summary(
            String mission,
            String collection,
            long events,
            long bytes,
            Instant first,
            Instant last,
            List<String> indexes,
            Duration retention) {}

    private record Document(String collection, String id, byte[] bson) implements EventDocument {}

    /** Returns all missions with an event, in alphabetical order. */
    public List<Summary> all() {
        List<Summary> all = new ArrayList<>();
        for (String name : collections.names()) {
            MongoCollection<RawBsonDocument> collection = collections.get(name);
            RawBsonDocument first = collection
                    .find()
                    .sort(Sorts.ascending(EventDocumentCodec.TIME))
                    .first();
            RawBsonDocument last = collection
                    .find()
                    .sort(Sorts.descending(EventDocumentCodec.TIME))
                    .first();
            if (first != null && last != null) {
                Map<String, Optional<Duration>> indexes = collections.indexes(name);
                all.add(new Summary(
                        MissionCollections.missionOf(name, () -> last),
                        name,
                        collection.countDocuments(),
                        collections.bytes(name),
                        time(first),
                        time(last),
                        List.copyOf(indexes.keySet()),
                        indexes.values().stream()
                                .flatMap(Optional::stream)
                                .findFirst()
                                .orElse(null)));
            }
        }
        return all;
    }

    /** Returns the collection of a mission, given its name or its encoded name in topics and collections. */
    String collection(String mission) {
        List<String> candidates = MissionCollections.candidates(mission);
        return candidates.stream().filter(name -> !isEmpty(name)).findFirst().orElse(candidates.get(0));
    }

    private boolean isEmpty(String collection) {
        return collections.get(collection).find().first() == null;
    }

    private static Instant time(RawBsonDocument document) {
        return Instant.ofEpochMilli(
                document.getDateTime(EventDocumentCodec.TIME).getValue());
    }

    /** Returns whether any event of the mission is stored. */
    public boolean has(String mission) {
        return !isEmpty(collection(mission));
    }

    /**
     * Writes all events of a mission as lines, in the order of their times; the same documents always produce the same
     * bytes.
     *
     * @param progress called at intervals with the number of events so far
     * @return number of events
     */
    public long export(String mission, OutputStream out, LongConsumer progress) throws IOException {
        long count = 0;
        try (Events events = events(mission)) {
            while (events.hasNext()) {
                out.write(ArchiveLine.write(events.next()));
                out.write('\n');
                if (++count % REPORT_INTERVAL == 0) {
                    progress.accept(count);
                }
            }
        }
        return count;
    }

    /**
     * Imports lines into a mission without duplicating stored events.
     *
     * @param source named in messages
     * @return number of lines
     * @throws IOException if a line is not an event, with an {@link UnreadableException} as cause, or the server rejects it; lines
     *     before it may be stored
     */
    @Override
    public long importFrom(String mission, InputStream in, String source, LongConsumer progress)
            throws IOException, InterruptedException {
        try (BulkSender<EventDocument> sender = new BulkSender<>(collections, WAITS, ignored -> {})) {
            String collection = collection(mission);
            List<EventDocument> bulk = new ArrayList<>(BATCH);
            BufferedReader lines = new BufferedReader(new InputStreamReader(new LineLimit(in), StandardCharsets.UTF_8));
            long count = 0;
            long bytes = 0;
            for (String line = lines.readLine(); line != null; line = lines.readLine()) {
                count++;
                bulk.add(document(collection, line, source + ", line " + count));
                bytes += line.length();
                if (bulk.size() == BATCH || bytes >= BATCH_BYTES) {
                    send(sender, bulk, source);
                    bytes = 0;
                }
                if (count % REPORT_INTERVAL == 0) {
                    progress.accept(count);
                }
            }
            send(sender, bulk, source);
            return count;
        }
    }

    private static EventDocument document(String collection, String line, String where) throws IOException {
        try {
            StoredEvent event = ArchiveLine.read(line);
            return new Document(collection, event.id(), EventDocumentCodec.write(event));
        } catch (UnreadableException e) {
            throw new IOException(where + " is not an event: " + e.getMessage(), e);
        }
    }

    private static void send(BulkSender<EventDocument> sender, List<EventDocument> bulk, String source)
            throws IOException, InterruptedException {
        for (BulkSender.Refusal<EventDocument> refusal : sender.send(bulk)) {
            throw new IOException("MongoDB rejected event %s of %s: %s"
                    .formatted(refusal.document().id(), source, refusal.reason()));
        }
        bulk.clear();
    }

    /** Returns the events of a mission in the order of archives. */
    Events events(String mission) {
        return new Events(collections
                .get(collection(mission))
                .find()
                .sort(Sorts.ascending(EventDocumentCodec.TIME))
                .batchSize(BATCH)
                .cursor());
    }

    @Override
    public void close() {
        client.close();
    }

    /** Reads events from the server on demand. */
    static final class Events implements Iterator<StoredEvent>, AutoCloseable {
        private final MongoCursor<RawBsonDocument> cursor;
        private final Iterator<StoredEvent> ordered;

        private Events(MongoCursor<RawBsonDocument> cursor) {
            this.cursor = cursor;
            this.ordered = EventOrder.within(new Iterator<>() {
                @Override
                public boolean hasNext() {
                    return cursor.hasNext();
                }

                @Override
                public StoredEvent next() {
                    return read(cursor.next());
                }
            });
        }

        private static StoredEvent read(RawBsonDocument document) {
            try {
                return EventDocumentCodec.read(document);
            } catch (UnreadableException e) {
                throw new UncheckedIOException(
                        "The collection holds a document that ingest did not write",
                        new IOException(e.getMessage(), e));
            }
        }

        @Override
        public boolean hasNext() {
            return ordered.hasNext();
        }

        @Override
        public StoredEvent next() {
            return ordered.next();
        }

        @Override
        public void close() {
            cursor.close();
        }
    }
}
