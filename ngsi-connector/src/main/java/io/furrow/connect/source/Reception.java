package io.furrow.connect.source;

import java.io.UncheckedIOException;
import java.net.InetSocketAddress;
import java.security.KeyStore;
import java.time.Duration;
import java.util.Map;
import java.util.Optional;
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

    private final Deliveries deliveries;
    private final NotificationServer server;

    private Reception(Deliveries deliveries, NotificationServer server) {
        this.deliveries = deliveries;
        this.server = server;
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
        Handler handler = new NotificationHandler(
                new NotificationHandler.Path(new Gatekeeper(config.security(), ledger), translator, deliveries),
                ledger,
                new NotificationHandler.Limits(
                        config.sizes().maxBodyBytes(),
                        new ByteBudget(config.overload().memoryBytes(), threads),
                        new ByteBudget(config.overload().translationMemoryBytes(), threads),
                        config.overload().hold().toNanos(),
                        config.overload().resets()),
                pages(config, ledger));
        Handler guarded = new AccessHandler(config.accessRule(), new ForeignRequests(ledger), handler);
        try {
            return new Reception(
                    deliveries, NotificationServer.start(settings(config), threads, guarded, ledger, patience));
        } catch (UncheckedIOException e) {
            deliveries.close();
            String remedy = "; free the address or change " + ListeningOptions.HOST + " or " + ListeningOptions.PORT;
            throw new ConnectException(e.getCause().getMessage() + remedy, e);
        }
    }

    private static Map<String, Supplier<Page>> pages(NgsiSourceConfig config, Ledger ledger) {
        PrometheusPage prometheus = new PrometheusPage(ledger, config.name(), config.taskIndex());
        return Map.of(
                "/health",
                () -> new Page("application/json", NgsiJson.write(LedgerJson.of(ledger))),
                "/metrics",
                () -> new Page(PrometheusPage.CONTENT_TYPE, prometheus.write()));
    }

    private static NotificationServer.Settings settings(NgsiSourceConfig config) {
        ListeningOptions listening = config.listening();
        return new NotificationServer.Settings(
                new InetSocketAddress(listening.host(), listening.port()),
                tls(config.tls()),
                listening.maxConnections(),
                listening.idleTimeout(),
                listening.requestTimeout());
    }

    private static Optional<SslContextFactory.Server> tls(TlsOptions options) {
        return options.keys().map(keys -> {
            SslContextFactory.Server tls = new SslContextFactory.Server();
            KeyStore store = KeyStores.keys(keys);
            tls.setKeyStore(store);
            tls.setKeyStorePassword(keys.password().value());
            options.trusted().map(KeyStores::certificates).ifPresent(tls::setTrustStore);
            tls.setNeedClientAuth(options.clientAuth().equals("required"));
            tls.setWantClientAuth(options.clientAuth().equals("requested"));
            return tls;
        });
    }

    /** The port that is listened on. */
    int port() {
        return server.port();
    }

    @Override
    public void close() {
        deliveries.close();
        server.close();
    }
}
