package io.furrow.bench.evaluation;

import java.lang.management.ManagementFactory;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Locale;
import java.util.Properties;
import java.util.SplittableRandom;
import java.util.function.IntFunction;

import com.sun.management.HotSpotDiagnosticMXBean;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.bench.http.BaselineServer;
import io.furrow.bench.http.HttpLoad;
import io.furrow.bench.notifications.BaselineProducer;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.launcher.suite.RunDirectory;

/**
 * The speed of this machine in these minutes, measured without Furrow.
 *
 * @param producer records of 1 kB a second written by one producer, all acknowledged
 * @param server requests of 1 kB a second answered by a Jetty that ignores them
 * @param bridge requests of 1 kB a second answered by a Jetty once Kafka has them
 */
record Calibration(double producer, double server, double bridge) {
    private static final Duration LASTING = Duration.ofSeconds(3);
    private static final int BYTES = 1_000;
    private static final int CONNECTIONS = 64;
    private static final int ENTITIES = 100;
    private static final long MEGABYTE = 1 << 20;

    /** Takes some 20 seconds. */
    static Calibration measure() throws Exception {
        try (RunDirectory directory = RunDirectory.open(null);
                EmbeddedKafka kafka = EmbeddedKafka.start(directory.resolve("kafka"))) {
            Properties client = new Properties();
            client.setProperty("bootstrap.servers", kafka.bootstrapServers());
            return new Calibration(
                    producing(client),
                    answered(BaselineServer.start()),
                    answered(BaselineServer.bridge(client, "calibration-bridge")));
        }
    }

    private static double producing(Properties client) {
        byte[] value = new byte[BYTES];
        new SplittableRandom(1).nextBytes(value);
        byte[] key = "device".getBytes(StandardCharsets.US_ASCII);
        IntFunction<ProducerRecord<byte[], byte[]>> records = number -> new ProducerRecord<>("calibration", key, value);
        BaselineProducer.perSecond(client, records, LASTING);
        return BaselineProducer.perSecond(client, records, LASTING);
    }

    /** Rate of the second of two runs. */
    private static double answered(BaselineServer started) {
        HttpLoad.Plan plan = new HttpLoad.Plan(CONNECTIONS, false, 0, BYTES, ENTITIES, LASTING);
        try (BaselineServer server = started) {
            new HttpLoad(server.address(), plan, 0).run();
            return new HttpLoad(server.address(), plan, 0).run().perSecond();
        }
    }

    /** Maximum heap of this JVM as configured, MB; {@link Runtime#maxMemory} depends on the collector's layout. */
    static long maxHeap() {
        return Long.parseLong(ManagementFactory.getPlatformMXBean(HotSpotDiagnosticMXBean.class)
                        .getVMOption("MaxHeapSize")
                        .getValue())
                / MEGABYTE;
    }

    /** A sentence for the head of a report. */
    String sentence() {
        return String.format(
                Locale.ROOT,
                "Machine: %d processors, %s %s, Java %s, heap of at most %,d MB. In the same minutes a bare producer writes %,.0f records of"
                        + " 1 kB per second, a bare HTTP server answers %,.0f requests per second, a bare bridge from HTTP to Kafka %,.0f.",
                Runtime.getRuntime().availableProcessors(),
                System.getProperty("os.name"),
                System.getProperty("os.arch"),
                System.getProperty("java.version"),
                maxHeap(),
                producer,
                server,
                bridge);
    }
}
