package io.furrow.ingest.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
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

    /** How many writes there were. */
    int attempts() {
        return attempts.get();
    }

    @Override
    public Document handleMessage(MongoMessage message) {
        Document command = message.getDocument();
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
