package io.furrow.dashboard;

import java.io.IOException;
import java.net.URI;
import java.time.Clock;
import java.time.Duration;
import java.util.List;
import java.util.Locale;

import org.apache.kafka.clients.admin.Admin;
import org.eclipse.jetty.ee10.servlet.ServletContextHandler;
import org.eclipse.jetty.ee10.servlet.ServletHolder;
import org.eclipse.jetty.ee10.websocket.server.JettyServerUpgradeRequest;
import org.eclipse.jetty.ee10.websocket.server.JettyServerUpgradeResponse;
import org.eclipse.jetty.ee10.websocket.server.config.JettyWebSocketServletContainerInitializer;
import org.eclipse.jetty.http.HttpStatus;
import org.eclipse.jetty.http.pathmap.ServletPathSpec;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.server.handler.PathMappingsHandler;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.thread.QueuedThreadPool;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.auth.ProxyHeaders;
import io.furrow.dashboard.auth.UserCache;
import io.furrow.dashboard.http.Problem;
import io.furrow.dashboard.image.ImageIndex;
import io.furrow.dashboard.image.ImageServlet;
import io.furrow.dashboard.page.ConfigServlet;
import io.furrow.dashboard.page.PageFiles;
import io.furrow.dashboard.page.TileFile;
import io.furrow.dashboard.proxy.DensityServlet;
import io.furrow.dashboard.proxy.HistoryServlet;
import io.furrow.dashboard.proxy.RegisterServlet;
import io.furrow.dashboard.proxy.StreamServlet;
import io.furrow.dashboard.proxy.TopicStreams;
import io.furrow.dashboard.proxy.TopicsServlet;
import io.furrow.dashboard.status.StatusPages;
import io.furrow.http.AccessRule;
import io.furrow.http.OptionNames;
import io.furrow.http.jetty.AccessHandler;
import io.furrow.kafka.Probe;
import io.furrow.kafka.Readiness;
import io.furrow.model.text.FailureText;

/**
 * Serves the page, topics as WebSockets and server-sent events, and the control plane's REST API under one origin.
 * Requests are forwarded with the token of their user.
 */
public final class Dashboard implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Dashboard.class);
    private static final int THREADS = 64;
    private static final long STOP_TIMEOUT_MILLIS = 2_000;
    private static final Duration IDLE_TIMEOUT = Duration.ofSeconds(60);
    private static final String SOCKETS = "/socket/";
    /** Requests below this path may wait for Kafka or the control plane. */
    private static final String MAY_WAIT = "/api/";

    /** Paths that the dashboard handles; the rest of {@code /api} belongs to the control plane. */
    private static final List<String> OWN_PATHS = List.of(
            "/api/register/*",
            "/api/stream/*",
            "/api/history/*",
            "/api/density/*",
            "/api/topics",
            "/api/images/*",
            "/api/platform",
            "/config.json",
            SOCKETS + "*");

    /** The control plane's API, and the description that its page at /api shows. */
    private static final List<String> FORWARDED = List.of("/api/*", "/openapi.json");

    private static final List<String> STATUS = List.of(StatusPages.HEALTH, StatusPages.READY, StatusPages.METRICS);
    /** The page fetches images with the user's token and shows them as blobs. */
    private static final String CONTENT_POLICY =
            "default-src 'self'; img-src 'self' data: blob:%s; object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

    private final QueuedThreadPool threads = new QueuedThreadPool(THREADS, 2);
    private final Server server = new Server(threads);
    private final TopicStreams streams;
    private final ImageIndex images;
    private final UserCache users;
    private final Admin admin;
    private final Readiness readiness = new Readiness(Clock.systemUTC());
    private final List<Probe> probes;

    private Dashboard(DashboardSettings settings) {
        this.users = new UserCache(settings.controlPlane(), System::nanoTime);
        this.streams = new TopicStreams(settings.client(), settings.rules(), settings.limits(), users);
        this.admin = Admin.create(settings.client());
        this.images = new ImageIndex(settings.client());
        URI health = URI.create(settings.controlPlane() + "/health");
        this.probes = List.of(
                new Probe("kafka", () -> streams.feeds().checkKafka(Probe.TIMEOUT), () -> {}),
                Probe.http("controlPlane", health));
        probes.forEach(probe -> readiness.require(probe::status));
    }

    /** @throws IOException if the port is in use */
    public static Dashboard start(DashboardSettings settings) throws IOException {
        Dashboard dashboard = new Dashboard(settings);
        try {
            dashboard.listen(settings);
        } catch (IOException e) {
            dashboard.close();
            throw e;
        }
        if (!settings.page().images().isEmpty()) {
            dashboard.images.start();
        }
        LOG.info("the dashboard listens on {}", dashboard.uri());
        return dashboard;
    }

    private void listen(DashboardSettings settings) throws IOException {
        ServerConnector connector =
                new ServerConnector(server, new HttpConnectionFactory(AccessHandler.configuration()));
        connector.setHost(settings.host());
        connector.setPort(settings.port());
        server.addConnector(connector);
        server.setStopTimeout(STOP_TIMEOUT_MILLIS);
        server.setErrorHandler(Dashboard::reject);
        threads.setName("dashboard");
        PathMappingsHandler paths = new PathMappingsHandler();
        Handler servlets = servlets(settings);
        for (String path : OWN_PATHS) {
            paths.addMapping(new ServletPathSpec(path), servlets);
        }
        Handler proxy = new ControlPlaneProxy(settings.controlPlane(), settings.rules());
        FORWARDED.forEach(path -> paths.addMapping(new ServletPathSpec(path), proxy));
        Handler status = new StatusPages(readiness, streams);
        STATUS.forEach(path -> paths.addMapping(new ServletPathSpec(path), status));
        if (settings.page().tileFile() != null) {
            paths.addMapping(
                    new ServletPathSpec(TileFile.PATH),
                    TileFile.handler(settings.page().tileFile()));
        }
        paths.addMapping(
                new ServletPathSpec("/"), PageFiles.handler(settings.page().folder()));
        AccessRule rule = AccessRule.allowing(settings.allowed(), OptionNames.FLAGS)
                .servedAs(settings.host())
                .withProbes(StatusPages.HEALTH, StatusPages.READY);
        Handler signedIn = new ProxyHeaders(settings.proxy(), users, streams.counters()::rejected, paths);
        Handler pooled = new RequestWorkers(path -> path.startsWith(MAY_WAIT), streams.counters()::rejected, signedIn);
        server.setHandler(new AccessHandler(
                rule,
                rejected -> {
                    streams.counters().rejected(rejected.error());
                    return Problem.json(rejected.error(), rejected.reason());
                },
                withSecurityHeaders(
                        pooled,
                        CONTENT_POLICY.formatted(originOf(settings.page().tiles())))));
        try {
            server.start();
        } catch (Exception e) { // Jetty declares no narrower type
            throw new IOException(
                    "The dashboard cannot listen on %s:%d (%s). Choose another port."
                            .formatted(settings.host(), settings.port(), FailureText.of(e)),
                    e);
        }
    }

    /** Answers requests that the HTTP server itself rejects, such as those for a file that does not exist. */
    private static boolean reject(Request request, Response response, Callback callback) {
        String reason = HttpStatus.getMessage(response.getStatus());
        String error = reason.toLowerCase(Locale.ROOT).replace(' ', '-');
        new Problem(response.getStatus(), error, reason + ": " + Request.getPathInContext(request))
                .answer(response, callback);
        return true;
    }

    /** Adds security headers to every response. */
    private static Handler withSecurityHeaders(Handler handler, String contentPolicy) {
        return new Handler.Wrapper(handler) {
            @Override
            public boolean handle(Request request, Response response, Callback callback) throws Exception {
                response.getHeaders().put("X-Content-Type-Options", "nosniff");
                response.getHeaders().put("Referrer-Policy", "no-referrer");
                response.getHeaders().put("Content-Security-Policy", contentPolicy);
                return super.handle(request, response, callback);
            }
        };
    }

    /** The origin of the map tiles, for the content policy. */
    private static String originOf(String tiles) {
        if (tiles == null) {
            return "";
        }
        URI base = URI.create(tiles.replaceAll("[{].*", ""));
        return " %s://%s".formatted(base.getScheme(), base.getRawAuthority());
    }

    private Handler servlets(DashboardSettings settings) {
        ServletContextHandler context = new ServletContextHandler("/");
        context.getServletHandler().setDecodeAmbiguousURIs(true);
        context.addServlet(new ServletHolder(new RegisterServlet(streams)), "/api/register/*");
        context.addServlet(new ServletHolder(new TopicsServlet(streams)), "/api/topics");
        context.addServlet(
                new ServletHolder(
                        new ImageServlet(users, images, settings.page().images(), streams.counters()::rejected)),
                "/api/images/*");
        context.addServlet(new ServletHolder(new ConfigServlet(settings.page())), "/config.json");
        context.addServlet(new ServletHolder(new HistoryServlet(streams, settings.client())), "/api/history/*");
        context.addServlet(new ServletHolder(new DensityServlet(streams, admin)), "/api/density/*");
        context.addServlet(
                new ServletHolder(new PlatformServlet(streams, admin, settings.controlPlane())), "/api/platform");
        ServletHolder events = new ServletHolder(new StreamServlet(streams));
        events.setAsyncSupported(true);
        context.addServlet(events, "/api/stream/*");
        JettyWebSocketServletContainerInitializer.configure(context, (servlets, container) -> {
            container.setMaxTextMessageSize(settings.limits().messageBytes());
            container.setIdleTimeout(IDLE_TIMEOUT);
            container.addMapping(SOCKETS + "*", this::open);
        });
        return context;
    }

    private Object open(JettyServerUpgradeRequest request, JettyServerUpgradeResponse response) throws IOException {
        try {
            String ticket = request.getRequestPath().substring(SOCKETS.length());
            return streams.open(ticket);
        } catch (Problem problem) {
            streams.counters().rejected(problem);
            response.sendError(problem.status(), problem.getMessage());
            return null;
        }
    }

    /** The address of the server. */
    public URI uri() {
        ServerConnector connector = (ServerConnector) server.getConnectors()[0];
        return URI.create("http://" + connector.getHost() + ":" + connector.getLocalPort());
    }

    /** The open streams. */
    public TopicStreams streams() {
        return streams;
    }

    @Override
    public void close() {
        probes.forEach(Probe::close);
        streams.close();
        images.close();
        admin.close(Duration.ofSeconds(1));
        try {
            server.stop();
        } catch (Exception e) { // Jetty declares no narrower type
            LOG.warn("the dashboard did not stop in order", e);
        }
    }
}
