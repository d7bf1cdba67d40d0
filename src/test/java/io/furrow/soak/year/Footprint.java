package io.furrow.soak.year;

import java.io.IOException;
import java.nio.file.FileVisitResult;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.SimpleFileVisitor;
import java.nio.file.attribute.BasicFileAttributes;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ExecutionException;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.TopicDescription;

import io.furrow.process.TestProcess;

/**
 * Measures a suite: topics, partitions, collections, alarms, files, threads, heap after a garbage collection in MB, and
 * the duration of its start.
 */
final class Footprint {
    private Footprint() {}

    static Map<String, Double> of(YearFarm farm, double startSeconds)
            throws IOException, InterruptedException, ExecutionException {
        Map<String, Double> all = new LinkedHashMap<>();
        try (Admin admin = Admin.create(Map.of("bootstrap.servers", farm.up.kafka()))) {
            Map<String, TopicDescription> topics = admin.describeTopics(
                            admin.listTopics().names().get())
                    .allTopicNames()
                    .get();
            all.put("topics", (double) topics.size());
            all.put("partitions", (double) topics.values().stream()
                    .mapToInt(topic -> topic.partitions().size())
                    .sum());
        }
        try (MongoClient mongo = MongoClients.create(farm.mongo())) {
            double collections = 0;
            for (String database : mongo.listDatabaseNames()) {
                for (String ignored : mongo.getDatabase(database).listCollectionNames()) {
                    collections++;
                }
            }
            all.put("collections", collections);
        }
        all.put("alarms", (double)
                farm.up.get("/api/alarms?state=open&limit=10000").size());
        all.put("files", files(farm.data));
        long pid = farm.up.javaProcess().pid();
        all.put("threads", (double)
                Files.list(Path.of("/proc", Long.toString(pid), "task")).count());
        all.put("heap MB", heapMegabytes(pid));
        all.put("start s", startSeconds);
        return all;
    }

    /** Counts files; some may be deleted meanwhile. */
    private static double files(Path folder) throws IOException {
        int[] count = {0};
        Files.walkFileTree(folder, new SimpleFileVisitor<>() {
            @Override
            public FileVisitResult visitFile(Path file, BasicFileAttributes attributes) {
                count[0]++;
                return FileVisitResult.CONTINUE;
            }

            @Override
            public FileVisitResult visitFileFailed(Path file, IOException e) {
                return FileVisitResult.CONTINUE;
            }

            @Override
            public FileVisitResult postVisitDirectory(Path folder, IOException e) {
                return FileVisitResult.CONTINUE;
            }
        });
        return count[0];
    }

    /** The size of all reachable objects; the histogram triggers a garbage collection. */
    private static double heapMegabytes(long pid) throws IOException, InterruptedException {
        List<String> lines = output("jcmd", Long.toString(pid), "GC.class_histogram");
        String[] total = lines.get(lines.size() - 1).trim().split("\\s+");
        return Math.round(Double.parseDouble(total[2]) / 1e5) / 10.0;
    }

    private static List<String> output(String... command) throws IOException, InterruptedException {
        return TestProcess.run(new ProcessBuilder(command))
                .output()
                .lines()
                .filter(line -> !line.isBlank())
                .toList();
    }
}
