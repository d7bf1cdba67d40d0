package io.furrow.bench.command;

import java.nio.file.Path;
import java.util.HashMap;
import java.util.Map;
import java.util.Properties;

import io.furrow.embedded.EmbeddedConnect;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.Closeables;
import io.furrow.launcher.suite.Connectors;
import io.furrow.launcher.suite.KafkaAccess;
import io.furrow.launcher.suite.RunDirectory;

/** A broker and a Connect worker with our connectors on free ports, for measurements that need no more. */
final class BenchCluster implements AutoCloseable {
    private final Closeables parts;
    private final KafkaAccess kafka;
    private final Connectors connectors;

    private BenchCluster(RunDirectory directory, Map<String, String> worker, Progress progress) throws Exception {
        parts = directory.closingFirst(new Closeables());
        LogFile.writeTo(directory.resolve("furrow.log"));
        EmbeddedKafka broker =
                parts.add("Kafka", progress.step("Kafka", () -> EmbeddedKafka.start(directory.resolve("kafka"))));
        kafka = parts.add("Kafka client", KafkaAccess.to(broker.bootstrapServers(), null));
        Path plugins = Path.of(System.getProperty("furrow.plugins"));
        EmbeddedConnect connect = parts.add(
                "Connect",
                progress.step(
                        "Kafka Connect",
                        () -> EmbeddedConnect.start(broker.bootstrapServers(), plugins, 0, new HashMap<>(worker))));
        connectors = new Connectors(connect.uri());
    }

    /** @param worker settings beside the usual ones */
    static BenchCluster start(RunDirectory directory, Map<String, String> worker, Progress progress) throws Exception {
        return new BenchCluster(directory, worker, progress);
    }

    /** For any Kafka client. */
    Properties kafka() {
        return kafka.clientProperties();
    }

    Connectors connectors() {
        return connectors;
    }

    @Override
    public void close() {
        parts.close();
    }
}
