package io.furrow.ingest.mission;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.concurrent.atomic.AtomicLong;
import java.util.stream.IntStream;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.ReplaceOneModel;
import com.mongodb.client.model.ReplaceOptions;
import org.bson.Document;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMongo;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** What a sudden end leaves of the embedded server's file is what a copy of it holds that is made while it writes. */
class MongoCopiedTest {
    private static final int WRITERS = 3;
    private static final int BULK = 8;
    private static final int COPIES = 6;

    private final AtomicLong written = new AtomicLong();

    @Test
    void holdsNoHalfOfADocument(@TempDir Path directory) throws Exception {
        AtomicBoolean over = new AtomicBoolean();
        ExecutorService writers = Executors.newFixedThreadPool(WRITERS);
        Path file = directory.resolve("whole/mongo.mv");
        try (EmbeddedMongo server = EmbeddedMongo.start(file.getParent())) {
            for (int writer = 0; writer < WRITERS; writer++) {
                String name = "w" + writer + "-";
                writers.submit(() -> write(server.uri(), name, over));
            }
            for (int copy = 0; copy < COPIES; copy++) {
                long more = written.get() + 50;
                await().until(() -> written.get() >= more);
                Path copied = Files.createDirectory(directory.resolve("copy" + copy));
                Files.copy(file, copied.resolve("mongo.mv"));
            }
            over.set(true);
            writers.shutdown();
            assertThat(writers.awaitTermination(10, TimeUnit.SECONDS)).isTrue();
        }
        for (int copy = 0; copy < COPIES; copy++) {
            try (EmbeddedMongo server = EmbeddedMongo.start(directory.resolve("copy" + copy));
                    MongoClient client = MongoClients.create(server.uri())) {
                takesAll(documents(client));
            }
        }
    }

    /** Also what is in the index of ids, without a document, would not be taken. */
    private static void takesAll(MongoCollection<Document> documents) {
        long most = documents.countDocuments() / WRITERS + 10 * BULK;
        for (int writer = 0; writer < WRITERS; writer++) {
            for (int begin = 0; begin < most; begin += BULK) {
                bulk(documents, "w" + writer + "-", begin);
            }
        }
    }

    private void write(String uri, String name, AtomicBoolean over) {
        try (MongoClient client = MongoClients.create(uri)) {
            for (int begin = 0; !over.get(); begin += BULK) {
                bulk(documents(client), name, begin);
                written.incrementAndGet();
            }
        }
    }

    private static void bulk(MongoCollection<Document> documents, String name, int begin) {
        List<ReplaceOneModel<Document>> upserts = IntStream.range(begin, begin + BULK)
                .mapToObj(number -> new ReplaceOneModel<>(
                        Filters.eq(name + number),
                        new Document("_id", name + number).append("n", number),
                        new ReplaceOptions().upsert(true)))
                .toList();
        documents.bulkWrite(upserts);
    }

    private static MongoCollection<Document> documents(MongoClient client) {
        return client.getDatabase("persistence").getCollection("mission_m");
    }
}
