package io.furrow.connect.source;

import java.io.UncheckedIOException;
import java.net.InetSocketAddress;
import java.time.Duration;
import java.time.Instant;
import java.util.Map;
import java.util.Optional;
import java.util.OptionalInt;
import java.util.function.Consumer;
import java.util.function.Supplier;

import org.apache.kafka.connect.errors.ConnectException;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.util.ssl.SslContextFactory;
import org.eclipse.jetty.util.thread.QueuedThreadPool;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.ledger.PrometheusPage;
import io.furrow.connect.source.http.AdmissionQueue;
import io.furrow.connect.source.http.ByteBudget;
import io.furrow.connect.source.http.KafkaSslContextFactory;
import io.furrow.connect.source.http.NotificationHandler;
import io.furrow.connect.source.http.NotificationServer;
import io.furrow.connect.source.http.RejectedRequestHandler;
import io.furrow.connect.source.http.RequestAuthenticator;
import io.furrow.connect.source.http.RequestHandler;
import io.furrow.connect.source.http.StatusHandler;
import io.furrow.connect.source.http.StatusPage;
import io.furrow.connect.source.http.TlsEngines;
import io.furrow.connect.source.journal.RecordLog;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.connect.source.option.ListeningOptions;
import io.furrow.connect.source.option.TlsOptions;
import io.furrow.http.jetty.AccessHandler;
import io.furrow.model.ngsi.NgsiJson;

/** Connects the port with the intake; closing it frees the port and answers all waiting senders. */
public final class NotificationEndpoint implements AutoCloseable {
    private static final int HEALTH_CONNECTIONS = 64;

    private final AdmissionQueue admissionQueue;
    private final NotificationServer server;
    private final Optional<NotificationServer> health;

    private NotificationEndpoint(
            AdmissionQueue admissionQueue, NotificationServer server, Optional<NotificationServer> health) {
        this.admissionQueue = admissionQueue;
        this.server = server;
        this.health = health;
    }

    /**
     * Listens and passes notifications to the intake.
     *
     * @param arrived receives the subscription of each notification that names one
     * @param timeout how long to wait for a port that is in use
     * @throws ConnectException if the source cannot listen on the address
     */
    static NotificationEndpoint open(
            NgsiSourceConfig config, RecordLog recordLog, Ledger ledger, Consumer<String> arrived, Duration timeout) {
        NotificationTranslator translator = new NotificationTranslator(config.translation(), ledger, arrived);
        QueuedThreadPool threads = NotificationServer.threads();
        AdmissionQueue admissionQueue = new AdmissionQueue(recordLog, ledger);
        Handler notifications = new NotificationHandler(
                translator,
                admissionQueue,
                ledger,
                new NotificationHandler.Limits(
                        config.sizes().maxBodyBytes(),
                        new ByteBudget(config.overload().memoryBytes(), threads),
                        new ByteBudget(config.overload().translationMemoryBytes(), threads),
                        config.overload().hold().toNanos(),
                        config.overload().resets()));
        Handler requests = new RequestHandler(
                new RequestAuthenticator(config.security(), ledger),
                notifications,
                new StatusHandler(pages(config, ledger)),
                config.sizes().maxBodyBytes());
        Optional<NotificationServer> health = Optional.empty();
        try {
            health = health(config, ledger, timeout);
            return new NotificationEndpoint(
                    admissionQueue,
                    NotificationServer.start(
                            settings(config, ledger), threads, guarded(config, ledger, requests), ledger, timeout),
                    health);
        } catch (UncheckedIOException e) {
            close(admissionQueue, health);
            String remedy = "; free the address or change " + ListeningOptions.HOST + ", " + ListeningOptions.PORT
                    + " or " + ListeningOptions.HEALTH_PORT;
            throw new ConnectException(e.getCause().getMessage() + remedy, e);
        } catch (RuntimeException e) {
            close(admissionQueue, health);
            throw e;
        }
    }

    /** Plain HTTP with separate threads, so that the pages stay available whatever happens to the listener. */
    private static Optional<NotificationServer> health(NgsiSourceConfig config, Ledger ledger, Duration timeout) {
        ListeningOptions listening = config.listening();
        OptionalInt port = listening.healthPort();
        return port.isEmpty()
                ? Optional.empty()
                : Optional.of(NotificationServer.start(
                        new NotificationServer.Settings(
                                new InetSocketAddress(listening.host(), port.getAsInt()),
                                Optional.empty(),
                                HEALTH_CONNECTIONS,
                                listening.idleTimeout(),
                                listening.requestTimeout(),
                                false),
                        NotificationServer.threads(),
                        guarded(config, ledger, new StatusHandler(pages(config, ledger))),
                        ledger,
                        timeout));
    }

    private static Handler guarded(NgsiSourceConfig config, Ledger ledger, Handler handler) {
        return new AccessHandler(config.accessRule(), new RejectedRequestHandler(ledger), handler);
    }

    private static Map<String, Supplier<StatusPage>> pages(NgsiSourceConfig config, Ledger ledger) {
        PrometheusPage prometheus = new PrometheusPage(ledger, config.name(), config.taskIndex());
        return Map.of(
                "/health",
                () -> new StatusPage("application/json", NgsiJson.write(ledger.toJson())),
                "/metrics",
                () -> new StatusPage(PrometheusPage.CONTENT_TYPE, prometheus.write()));
    }

    private static NotificationServer.Settings settings(NgsiSourceConfig config, Ledger ledger) {
        ListeningOptions listening = config.listening();
        return new NotificationServer.Settings(
                new InetSocketAddress(listening.host(), listening.port()),
                tls(config.tls(), ledger),
                listening.maxConnections(),
                listening.idleTimeout(),
                listening.requestTimeout(),
                config.overload().resets());
    }

    private static Optional<SslContextFactory.Server> tls(TlsOptions options, Ledger ledger) {
        if (!options.isOn()) {
            return Optional.empty();
        }
        TlsEngines engines = TlsEngines.open(options);
        if (engines.expiry().isPresent()) {
            ledger.gauge(
                    "certificateExpirySeconds",
                    "Unix time in seconds at which the first of the listener's certificates expires",
                    () -> engines.expiry().map(Instant::getEpochSecond).orElse(0L));
        }
        return Optional.of(new KafkaSslContextFactory(engines));
    }

    /** The port of the listener. */
    public int port() {
        return server.port();
    }

    /** The port of the separate server for the pages; empty if there is none. */
    OptionalInt healthPort() {
        return health.map(NotificationServer::port).map(OptionalInt::of).orElseGet(OptionalInt::empty);
    }

    private static void close(AdmissionQueue admissionQueue, Optional<NotificationServer> health) {
        admissionQueue.close();
        health.ifPresent(NotificationServer::close);
    }

    @Override
    public void close() {
        close(admissionQueue, health);
        server.close();
    }
}
