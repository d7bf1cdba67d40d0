package io.furrow.bench.mongo;

import java.util.ArrayList;
import java.util.List;

import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Figures;
import io.furrow.embedded.EmbeddedMongo;

/** {@code ./furrow bench mongo}. */
@Command(
        name = "mongo",
        description = "Writes events of a mission into MongoDB as the job ingest does, and in a bare loop around"
                + " MongoDB's driver, by turns, and prints documents per second of both.")
public final class MongoBench extends Benchmark {
    @Option(names = "--documents", paramLabel = "N", description = "Documents a turn. " + DEFAULT)
    private int documents = 50_000;

    @Option(names = "--payload", paramLabel = "BYTES", description = "Length of an event's JSON. " + DEFAULT)
    private int payload = 1000;

    @Option(names = "--turns", paramLabel = "N", description = "Turns that count. " + DEFAULT)
    private int turns = 5;

    @Option(
            names = "--mongo",
            paramLabel = "URI",
            description = "MongoDB, whose database persistence is EMPTIED. Default: an embedded server in" + " memory.")
    private String uri;

    @Override
    public Integer call() throws Exception {
        try (EmbeddedMongo embedded = uri == null ? EmbeddedMongo.inMemory() : null) {
            MongoMeasurement measurement = new MongoMeasurement(uri == null ? embedded.uri() : uri, documents, payload);
            Figures figures = new Figures("");
            List<Double> ratios = new ArrayList<>();
            for (int turn = 0; turn <= turns; turn++) { // the first does not count, because the JVM is cold
                double bare = measurement.bare();
                double writer = measurement.writer();
                say("bare loop %,.0f/s, sink writer %,.0f/s".formatted(bare, writer));
                if (turn > 0) {
                    ratios.add(writer / bare);
                    figures.add("turn", turn, "bare loop/s", bare, "sink writer/s", writer, "ratio", writer / bare);
                }
            }
            print(figures);
            print("median of the ratios: %.2f%n", Figures.median(ratios, ratio -> ratio));
        }
        return 0;
    }
}
