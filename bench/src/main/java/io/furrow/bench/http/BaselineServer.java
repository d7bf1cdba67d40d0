package io.furrow.bench.http;

import java.net.InetSocketAddress;
import java.nio.ByteBuffer;
import java.util.Properties;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.eclipse.jetty.io.Content;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.util.BufferUtil;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.Promise;
import org.eclipse.jetty.util.component.LifeCycle;
import org.eclipse.jetty.util.thread.QueuedThreadPool;

/**
 * A Jetty on 127.0.0.1 that reads each body and answers 200: either it discards the body, an upper limit for any receiver built on it;
 * or it answers once Kafka has it, the simplest bridge without loss of acknowledged data.
 */
public final class BaselineServer implements AutoCloseable {
    private static final int THREADS = 16;
    private static final String LINGER_MS = "1";

    private final Server server;
    private final ServerConnector connector;
    private Producer<byte[], byte[]> producer;

    /** Answers a request without blocking. */
    public interface Action {
        void handle(Request request, Response response, Callback callback);
    }

    private BaselineServer(String threadName, Action action) {
        QueuedThreadPool threads = new QueuedThreadPool(THREADS, 4);
        threads.setName(threadName);
        threads.setDaemon(true);
        server = new Server(threads);
        HttpConfiguration http = new HttpConfiguration();
        http.setSendServerVersion(false);
        connector = new ServerConnector(server, 1, 1, new HttpConnectionFactory(http));
        connector.setHost("127.0.0.1");
        connector.setAcceptQueueSize(1024);
        server.addConnector(connector);
        server.setHandler(new Handler.Abstract.NonBlocking() {
            @Override
            public boolean handle(Request request, Response response, Callback callback) {
                action.handle(request, response, callback);
                return true;
            }
        });
    }

    /** Starts on a free port. @param threadName of its threads */
    public static BaselineServer start(String threadName, Action action) {
        BaselineServer started = new BaselineServer(threadName, action);
        LifeCycle.start(started.server);
        return started;
    }

    /** Starts one that discards what it reads. */
    public static BaselineServer start() {
        return start(
                "bare-server",
                (request, response, callback) -> Content.Source.consumeAll(
                        request, Callback.from(() -> answer(200, response, callback), callback::failed)));
    }

    /**
     * Starts a bridge to a topic. Its producer batches what arrives while a request is in flight, since each sender waits for its
     * answer: the default {@code linger.ms} of 5 would only add delay.
     */
    public static BaselineServer bridge(Properties kafka, String topic) {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty("acks", "all");
        settings.setProperty("linger.ms", LINGER_MS);
        settings.setProperty("max.in.flight.requests.per.connection", "5");
        Producer<byte[], byte[]> producer =
                new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer());
        Action forward = (request, response, callback) -> Content.Source.asByteBuffer(
                request,
                Promise.from(
                        body -> producer.send(
                                new ProducerRecord<>(topic, BufferUtil.toArray(body)),
                                (metadata, failure) -> answer(failure == null ? 200 : 503, response, callback)),
                        callback::failed));
        BaselineServer bridge = start("bare-server", forward);
        bridge.producer = producer;
        return bridge;
    }

    private static void answer(int status, Response response, Callback callback) {
        response.setStatus(status);
        response.write(true, ByteBuffer.allocate(0), callback);
    }

    public InetSocketAddress address() {
        return new InetSocketAddress("127.0.0.1", connector.getLocalPort());
    }

    @Override
    public void close() {
        LifeCycle.stop(server);
        if (producer != null) {
            producer.close();
        }
    }
}
