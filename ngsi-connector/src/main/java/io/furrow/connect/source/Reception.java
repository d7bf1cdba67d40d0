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
import io.furrow.connect.ledger.LedgerJson;
import io.furrow.connect.ledger.PrometheusPage;
import io.furrow.http.jetty.AccessHandler;
import io.furrow.model.ngsi.NgsiJson;

/** Everything between the port and the intake; closing it frees the port and answers whoever waits. */
final class Reception implements AutoCloseable {
    private static final Duration BIND_PATIENCE = Duration.ofSeconds(10);
    private static final int HEALTH_CONNECTIONS = 64;

    private final Deliveries deliveries;
    private final NotificationServer server;
    private final Optional<NotificationServer> health;

    private Reception(Deliveries deliveries, NotificationServer server, Optional<NotificationServer> health) {
        this.deliveries = deliveries;
        this.server = server;
        this.health = health;
    }

    /**
     * Listens, and gives what comes to the intake.
     *
     * @throws ConnectException if the address cannot be listened on
     */
    static Reception open(NgsiSourceConfig config, Intake intake, Ledger ledger) {
        return open(config, intake, ledger, BIND_PATIENCE);
    }

    /** @param patience how long to wait for a port that is taken */
    static Reception open(NgsiSourceConfig config, Intake intake, Ledger ledger, Duration patience) {
        return open(config, new NotificationTranslator(config.translation(), ledger), intake, ledger, patience);
    }

    /** @param arrived is told the subscription of each notification that names one */
    static Reception open(NgsiSourceConfig config, Intake intake, Ledger ledger, Consumer<String> arrived) {
        NotificationTranslator translator = new NotificationTranslator(config.translation(), ledger, arrived);
        return open(config, translator, intake, ledger, BIND_PATIENCE);
    }

    private static Reception open(
            NgsiSourceConfig config,
            NotificationTranslator translator,
            Intake intake,
            Ledger ledger,
            Duration patience) {
        QueuedThreadPool threads = NotificationServer.threads();
        Deliveries deliveries = new Deliveries(intake, ledger);
        Handler notifications = new NotificationHandler(
                translator,
                deliveries,
                ledger,
                new NotificationHandler.Limits(
                        config.sizes().maxBodyBytes(),
                        new ByteBudget(config.overload().memoryBytes(), threads),
                        new ByteBudget(config.overload().translationMemoryBytes(), threads),
                        config.overload().hold().toNanos(),
                        config.overload().resets()));
        Handler requests = new RequestHandler(
                new Gatekeeper(config.security(), ledger),
                notifications,
                new PageHandler(pages(config, ledger)),
                config.sizes().maxBodyBytes());
        Optional<NotificationServer> health = Optional.empty();
        try {
            health = health(config, ledger, patience);
            return new Reception(
                    deliveries,
                    NotificationServer.start(
                            settings(config, ledger), threads, guarded(config, ledger, requests), ledger, patience),
                    health);
        } catch (UncheckedIOException e) {
            close(deliveries, health);
            String remedy = "; free the address or change " + ListeningOptions.HOST + ", " + ListeningOptions.PORT
                    + " or " + ListeningOptions.HEALTH_PORT;
            throw new ConnectException(e.getCause().getMessage() + remedy, e);
        } catch (RuntimeException e) {
            close(deliveries, health);
            throw e;
        }
    }

    /** In plain HTTP, with threads of its own: what becomes of the listener must not keep anybody from seeing it. */
    private static Optional<NotificationServer> health(NgsiSourceConfig config, Ledger ledger, Duration patience) {
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
                                listening.requestTimeout()),
                        NotificationServer.threads(),
                        guarded(config, ledger, new PageHandler(pages(config, ledger))),
                        ledger,
                        patience));
    }

    private static Handler guarded(NgsiSourceConfig config, Ledger ledger, Handler handler) {
        return new AccessHandler(config.accessRule(), new ForeignRequests(ledger), handler);
    }

    private static Map<String, Supplier<Page>> pages(NgsiSourceConfig config, Ledger ledger) {
        PrometheusPage prometheus = new PrometheusPage(ledger, config.name(), config.taskIndex());
        return Map.of(
                "/health",
                () -> new Page("application/json", NgsiJson.write(LedgerJson.of(ledger))),
                "/metrics",
                () -> new Page(PrometheusPage.CONTENT_TYPE, prometheus.write()));
    }

    private static NotificationServer.Settings settings(NgsiSourceConfig config, Ledger ledger) {
        ListeningOptions listening = config.listening();
        return new NotificationServer.Settings(
                new InetSocketAddress(listening.host(), listening.port()),
                tls(config.tls(), ledger),
                listening.maxConnections(),
                listening.idleTimeout(),
                listening.requestTimeout());
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

    /** The port that is listened on. */
    int port() {
        return server.port();
    }

    /** The port of the pages alone; empty where there is none. */
    OptionalInt healthPort() {
        return health.map(NotificationServer::port).map(OptionalInt::of).orElseGet(OptionalInt::empty);
    }

    private static void close(Deliveries deliveries, Optional<NotificationServer> health) {
        deliveries.close();
        health.ifPresent(NotificationServer::close);
    }

    @Override
    public void close() {
        close(deliveries, health);
        server.close();
    }
}
