package io.furrow.connect.source.http;

import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.TimeUnit;

import org.eclipse.jetty.server.LocalConnector;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.thread.QueuedThreadPool;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.source.NgsiSourceConfig;
import io.furrow.connect.source.journal.RecordLog;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.files.Gzip;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * What a fuzzer throws at bodies with {@code Content-Encoding: gzip}: the first byte picks how the others become one, as they
 * are, or as what one member, two members or a member of much more holds; and whether it comes in chunks. Whatever it is, its
 * sender has one answer, all memory that it took is given back, a dead letter holds no more than a body may; and what is one
 * member of gzip becomes what it becomes without.
 */
public final class FuzzGzip {
    private static final int MAX_BODY = 8 * 1024;
    private static final int MANY = 200;
    private static final int CHUNK = 7;
    private static final long TIMEOUT_SECONDS = 60;

    private final ConcurrentLinkedQueue<KafkaRecord> taken = new ConcurrentLinkedQueue<>();
    private final Ledger ledger = new Ledger();
    private final Server server;
    private final LocalConnector connector;
    private final ByteBudget bodies;
    private final ByteBudget translations;

    private static FuzzGzip open;

    private record Outcome(int status, List<KafkaRecord> records) {
        boolean isSame(Outcome other) {
            if (status != other.status || records.size() != other.records.size()) {
                return false;
            }
            for (int i = 0; i < records.size(); i++) {
                KafkaRecord one = records.get(i);
                KafkaRecord two = other.records.get(i);
                if (!one.topic().equals(two.topic())
                        || !java.util.Objects.equals(one.key(), two.key())
                        || !Arrays.equals(one.value(), two.value())) {
                    return false;
                }
            }
            return true;
        }
    }

    private FuzzGzip() {
        NgsiSourceConfig config = new NgsiSourceConfig(Map.of("journal.dir", "/tmp/journal"));
        QueuedThreadPool threads = NotificationServer.threads();
        bodies = new ByteBudget(4 * MAX_BODY, threads);
        translations = new ByteBudget(64L * 1024 * 1024, threads);
        RecordLog recordLog = records -> {
            taken.addAll(records);
            return Optional.of(CompletableFuture.completedFuture(null));
        };
        server = new Server(threads);
        server.setHandler(new RequestHandler(
                new RequestAuthenticator(config.security(), ledger),
                new NotificationHandler(
                        new NotificationTranslator(config.translation(), ledger),
                        new AdmissionQueue(recordLog, ledger),
                        ledger,
                        new NotificationHandler.Limits(
                                MAX_BODY, bodies, translations, TimeUnit.SECONDS.toNanos(TIMEOUT_SECONDS), false)),
                new StatusHandler(Map.of()),
                MAX_BODY));
        connector = new LocalConnector(server);
        server.addConnector(connector);
        LifeCycle.start(server);
    }

    /** Called by the fuzzer first: loading classes takes long on a busy machine, and no input hangs because of it. */
    public static void fuzzerInitialize() throws Exception {
        fuzzerTestOneInput("1{\"id\": \"a\"}".getBytes(UTF_8));
        fuzzerTestOneInput("0no gzip".getBytes(UTF_8));
    }

    /** One body; throws whatever is wrong. */
    public static synchronized void fuzzerTestOneInput(byte[] input) throws Exception {
        if (input.length == 0) {
            return;
        }
        if (open == null) {
            open = new FuzzGzip();
        }
        open.test(input[0] & 3, (input[0] & 4) == 4, Arrays.copyOfRange(input, 1, input.length));
    }

    /** Ends the server, if there is one. */
    public static synchronized void close() {
        if (open != null) {
            LifeCycle.stop(open.server);
            open = null;
        }
    }

    private void test(int how, boolean inChunks, byte[] rest) throws Exception {
        byte[] content = how == 3 ? many(rest) : rest;
        Outcome outcome = switch (how) {
            case 0 -> post(rest, "Content-Encoding: gzip\r\n", inChunks);
            case 2 -> {
                int half = content.length / 2;
                byte[] first = Gzip.of(Arrays.copyOf(content, half));
                byte[] second = Gzip.of(Arrays.copyOfRange(content, half, content.length));
                byte[] both = Arrays.copyOf(first, first.length + second.length);
                System.arraycopy(second, 0, both, first.length, second.length);
                yield post(both, "Content-Encoding: gzip\r\n", inChunks);
            }
            default -> post(Gzip.of(content), "Content-Encoding: gzip\r\n", inChunks);
        };
        check(outcome);
        if (how == 1 || how == 3) {
            Outcome plain = post(content, "", inChunks);
            require(outcome.isSame(plain), "gzip: " + outcome.status() + ", without: " + plain.status());
        }
    }

    private void check(Outcome outcome) {
        require(
                outcome.status() == 200 || outcome.status() == 400 || outcome.status() == 413,
                "answered " + outcome.status());
        require(
                outcome.status() == 400 || !outcome.records().isEmpty() || ledger.excluded.sum() > 0,
                "nothing came of it");
        require(ledger.overload.sum() == 0, "it counts as overload");
        outcome.records()
                .forEach(record -> require(
                        record.value() == null || record.key() != null || record.value().length <= MAX_BODY,
                        "a dead letter larger than a body"));
        requireFree(bodies);
        requireFree(translations);
    }

    private static void requireFree(ByteBudget budget) {
        CompletableFuture<Void> all = budget.take(budget.size(), 0);
        require(all.isDone() && !all.isCompletedExceptionally(), "memory was not given back");
        budget.giveBack(budget.size());
    }

    private Outcome post(byte[] body, String header, boolean inChunks) throws Exception {
        taken.clear();
        ByteArrayOutputStream request = new ByteArrayOutputStream();
        String head = "POST /v2/notify HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + header;
        if (inChunks) {
            request.writeBytes((head + "Transfer-Encoding: chunked\r\n\r\n").getBytes(US_ASCII));
            for (int from = 0; from < body.length; from += CHUNK) {
                int length = Math.min(CHUNK, body.length - from);
                request.writeBytes((Integer.toHexString(length) + "\r\n").getBytes(US_ASCII));
                request.write(body, from, length);
                request.writeBytes("\r\n".getBytes(US_ASCII));
            }
            request.writeBytes("0\r\n\r\n".getBytes(US_ASCII));
        } else {
            request.writeBytes((head + "Content-Length: " + body.length + "\r\n\r\n").getBytes(US_ASCII));
            request.writeBytes(body);
        }
        ByteBuffer answer =
                connector.getResponse(ByteBuffer.wrap(request.toByteArray()), false, TIMEOUT_SECONDS, TimeUnit.SECONDS);
        require(answer != null && answer.remaining() > "HTTP/1.1 200".length(), "there is no answer");
        String text = US_ASCII.decode(answer).toString();
        return new Outcome(Integer.parseInt(text.substring(9, 12)), List.copyOf(taken));
    }

    private static byte[] many(byte[] content) {
        byte[] many = new byte[content.length * MANY];
        for (int i = 0; i < MANY; i++) {
            System.arraycopy(content, 0, many, i * content.length, content.length);
        }
        return many;
    }

    private static void require(boolean right, String message) {
        if (!right) {
            throw new IllegalStateException(message);
        }
    }
}
