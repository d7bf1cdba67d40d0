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
 * A Jetty on 127.0.0.1 that reads each body and answers 200: one that forgets it, which no receiver built on it can exceed; or one that
 * answers when Kafka has it, the simplest bridge that loses nothing that it acknowledged.
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

    /** On a free port. @param threadName of its threads */
    public static BaselineServer start(String threadName, Action action) {
        BaselineServer started = new BaselineServer(threadName, action);
        LifeCycle.start(started.server);
        return started;
    }

    /** One that forgets what it reads. */
    public static BaselineServer start() {
        return start(
                "bare-server",
                (request, response, callback) -> Content.Source.consumeAll(
                        request, Callback.from(() -> answer(200, response, callback), callback::failed)));
    }

    /**
     * A bridge to a topic. Its producer sends what has come when an earlier request is on its way, since each sender waits for its
     * answer: with the default {@code linger.ms} of 5 they would only wait longer.
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
