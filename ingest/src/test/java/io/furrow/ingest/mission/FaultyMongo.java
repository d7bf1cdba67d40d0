package io.furrow.ingest.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicInteger;

import de.bwaldvogel.mongo.MongoServer;
import de.bwaldvogel.mongo.ServerVersion;
import de.bwaldvogel.mongo.backend.memory.MemoryBackend;
import de.bwaldvogel.mongo.bson.Document;
import de.bwaldvogel.mongo.wire.message.MongoMessage;

/** A server in memory that answers writes with codes which the stand-in for MongoDB never gives. */
final class FaultyMongo extends MemoryBackend {
    private final Map<String, Fault> ofDocuments = new ConcurrentHashMap<>();
    private final AtomicInteger attempts = new AtomicInteger();
    private final MongoServer server;
    private volatile Fault ofWrites = new Fault(0, 0);
    private final Map<String, Object> expireAfter = new ConcurrentHashMap<>();
    private final List<String> indexCommands = new CopyOnWriteArrayList<>();
    private volatile int ofAlterations;

    private record Fault(int code, int firstAttempts) {}

    FaultyMongo() {
        version(ServerVersion.MONGO_5_0);
        server = new MongoServer(this);
        server.bind("127.0.0.1", 0);
    }

    String uri() {
        return "mongodb://127.0.0.1:" + server.getLocalAddress().getPort();
    }

    /** The first so many writes with this document are answered with an error of it; all others pass. */
    void refuse(String id, int code, int firstAttempts) {
        ofDocuments.put(id, new Fault(code, firstAttempts));
    }

    /** The first so many writes fail as a whole. */
    void failWrites(int code, int firstAttempts) {
        ofWrites = new Fault(code, firstAttempts);
    }

    /** Every command to alter an index fails. */
    void failAlterations(int code) {
        ofAlterations = code;
    }

    /** What was altered or removed of indexes, in order; of a collection as {@link #expireAfter}. */
    List<String> indexCommands() {
        return indexCommands;
    }

    /** The retention that an index on event time has in seconds; null if none. */
    Object expireAfter(String collection) {
        return expireAfter.get(collection);
    }

    /** How many writes there were. */
    int attempts() {
        return attempts.get();
    }

    @Override
    public Document handleMessage(MongoMessage message) {
        Document command = message.getDocument();
        if (command.containsKey("collMod") || command.containsKey("dropIndexes")) {
            return changeIndex(command, message);
        }
        if (command.containsKey("createIndexes") && isConflict(command)) {
            return error(85).append("ok", 0.0);
        }
        if (!command.containsKey("update")) {
            return super.handleMessage(message);
        }
        int attempt = attempts.incrementAndGet();
        if (attempt <= ofWrites.firstAttempts()) {
            return error(ofWrites.code()).append("ok", 0.0);
        }
        List<Object> errors = refused(command, attempt);
        Document answer = super.handleMessage(message);
        return errors.isEmpty() ? answer : answer.append("writeErrors", errors);
    }

    private Document changeIndex(Document command, MongoMessage message) {
        if (command.containsKey("dropIndexes")) {
            indexCommands.add("dropIndexes");
            expireAfter.remove(String.valueOf(command.get("dropIndexes")));
            return super.handleMessage(message);
        }
        indexCommands.add("collMod");
        if (ofAlterations != 0) {
            return error(ofAlterations).append("ok", 0.0);
        }
        expireAfter.put(
                String.valueOf(command.get("collMod")), ((Document) command.get("index")).get("expireAfterSeconds"));
        return new Document("ok", 1.0);
    }

    /** Whether an index on event time is there with another retention, as MongoDB looks at it. */
    private boolean isConflict(Document command) {
        Document index = (Document) ((List<?>) command.get("indexes")).get(0);
        Object seconds = index.getOrDefault("expireAfterSeconds", "none");
        return index.get("name").equals("event-time")
                && !seconds.equals(expireAfter.computeIfAbsent(
                        String.valueOf(command.get("createIndexes")), collection -> seconds));
    }

    /** Takes what is refused out of the command. */
    private List<Object> refused(Document command, int attempt) {
        List<Object> passing = new ArrayList<>();
        List<Object> errors = new ArrayList<>();
        int index = 0;
        for (Object update : (List<?>) command.get("updates")) {
            Document query = (Document) ((Document) update).get("q");
            Fault fault = ofDocuments.get(String.valueOf(query.get("_id")));
            if (fault != null && attempt <= fault.firstAttempts()) {
                errors.add(error(fault.code()).append("index", index));
            } else {
                passing.add(update);
            }
            index++;
        }
        command.put("updates", passing);
        return errors;
    }

    private static Document error(int code) {
        return new Document("code", code).append("errmsg", "made up, code " + code);
    }

    /** Ends the server, which closes this. */
    void stop() {
        server.shutdownNow();
    }
}
