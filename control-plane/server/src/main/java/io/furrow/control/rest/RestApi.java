package io.furrow.control.rest;

import java.io.IOException;
import java.lang.reflect.Type;
import java.net.URI;
import java.nio.ByteBuffer;
import java.util.List;
import java.util.Locale;

import org.eclipse.jetty.ee10.servlet.ServletContextHandler;
import org.eclipse.jetty.ee10.servlet.ServletHolder;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.http.HttpStatus;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.server.SslConnectionFactory;
import org.eclipse.jetty.server.handler.gzip.GzipHandler;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.thread.QueuedThreadPool;
import org.glassfish.jersey.internal.inject.AbstractBinder;
import org.glassfish.jersey.server.ResourceConfig;
import org.glassfish.jersey.server.ServerProperties;
import org.glassfish.jersey.servlet.ServletContainer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.ControlSettings;
import io.furrow.control.ServiceTopics;
import io.furrow.control.device.DeviceCommands;
import io.furrow.control.device.DeviceCredentials;
import io.furrow.control.rest.access.FileWarnings;
import io.furrow.control.rest.access.PatchOverrideFilter;
import io.furrow.control.rest.access.ProblemDetails;
import io.furrow.control.rest.access.RoleFilter;
import io.furrow.control.rest.access.TlsListener;
import io.furrow.control.rest.access.TokenFilter;
import io.furrow.control.rest.access.VersionFilter;
import io.furrow.control.rest.description.ApiDescription;
import io.furrow.control.rest.description.ApiPage;
import io.furrow.control.rest.description.IsoTimeFilter;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.DeviceHistory;
import io.furrow.control.rest.view.EventTiles;
import io.furrow.control.rest.view.KafkaReads;
import io.furrow.control.rest.view.MarkerStore;
import io.furrow.control.rest.view.PendingReplies;
import io.furrow.control.rest.view.ReplayStatusView;
import io.furrow.control.rest.view.ResourceFeeds;
import io.furrow.control.rest.view.StateView;
import io.furrow.control.rest.view.StateViewUpdater;
import io.furrow.http.AccessRule;
import io.furrow.http.OptionNames;
import io.furrow.http.jetty.AccessHandler;
import io.furrow.kafka.Readiness;
import io.furrow.model.control.CommandResult;
import io.furrow.model.field.FieldReader;
import io.furrow.model.text.FailureText;

/**
 * Runs the REST API of the control plane. It communicates with the managers only through topics, so that any number of
 * instances can run, in the same process or elsewhere.
 */
public final class RestApi implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(RestApi.class);
    private static final int THREADS = 32;
    private static final int MAX_READERS = 2;
    private static final long STOP_TIMEOUT_MS = 2000;
    private static final int MIN_COMPRESSED_BYTES = 1024;

    private final QueuedThreadPool threads = new QueuedThreadPool(THREADS, 2);
    private final StateView view = new StateView();
    private final PendingReplies answers = new PendingReplies();
    private final Server server = new Server(threads);
    private final RestMetrics metrics;
    private final StateViewUpdater reader;
    private final CommandClient managers;
    private final ReplayStatusView replays = new ReplayStatusView(view);
    private final ResourceFeeds feeds = new ResourceFeeds();
    private final MarkerStore markers;
    /** Null if there is no MongoDB. */
    private final EventTiles events;
    /** Null if there is no MongoDB. */
    private final DeviceHistory history;

    private RestApi(ControlSettings control, RestSettings rest, Readiness readiness) {
        metrics = new RestMetrics(view, answers, readiness);
        // A manager may retain an id longer by a twelfth, see RequestLog.
        reader = new StateViewUpdater(
                control.client(), control.requestRetention().multipliedBy(13).dividedBy(12), view, answers);
        managers = new CommandClient(control.client(), answers, view, rest.timeout(), threads);
        markers = new MarkerStore(control.replays(), threads);
        events = EventTiles.of(control.replays());
        history = DeviceHistory.of(view, control.replays());
        view.listen(feeds);
    }

    /** Starts an API that cannot import field files. @throws IOException as the other start */
    public static RestApi start(ControlSettings control, RestSettings rest, Readiness readiness) throws IOException {
        return start(control, rest, readiness, FieldReader.NONE);
    }

    /**
     * Prepares the topics and starts listening; until the topics are read, requests are answered with 503.
     *
     * @param readiness of this process, to which the API is added
     * @param fields reads imported files
     * @throws IOException if the topics cannot be prepared, the farm has another secret, tokens or certificate cannot
     *     be read, or the port is in use
     */
    public static RestApi start(ControlSettings control, RestSettings rest, Readiness readiness, FieldReader fields)
            throws IOException {
        rest.check();
        TokenFilter tokens = rest.tokens() == null ? null : TokenFilter.read(rest.tokens());
        TlsListener tls = rest.certificate() == null ? null : TlsListener.open(rest.certificate());
        check(control, rest);
        RestApi api = new RestApi(control, rest, readiness);
        try {
            readiness.warn(new FileWarnings(rest.secret(), tokens, tls));
            api.listen(rest, tls, api.resources(control, rest, readiness, tokens, fields));
        } catch (IOException e) {
            api.close();
            throw e;
        }
        api.reader.start();
        LOG.info("the REST API of the control plane listens on {}", api.uri());
        return api;
    }

    /**
     * Prepares the topics and checks address and secret like {@link #start}. Called before managers join their group,
     * so that a process with wrong settings does not trigger a rebalance.
     *
     * @throws IOException as {@link #start}
     */
    public static void check(ControlSettings control, RestSettings rest) throws IOException {
        rest.check();
        ServiceTopics.prepare(control);
        if (rest.secret() != null) {
            rest.secret().verify();
        }
    }

    private ResourceConfig resources(
            ControlSettings control, RestSettings rest, Readiness readiness, TokenFilter tokens, FieldReader fields)
            throws IOException {
        readiness.require(reader::status);
        DeviceCommands commands = rest.contextBroker() == null
                ? null
                : new DeviceCommands(rest.contextBroker(), control.missions().scope(), rest.token());
        DeviceCredentials credentials =
                rest.secret() == null ? null : new DeviceCredentials(rest.secret(), rest.mqtt());
        DevicesResource.Dependencies dependencies =
                new DevicesResource.Dependencies(control.missions().scope(), commands, credentials, history);
        ApiDescription description = ApiDescription.read();
        StateWait waits = new StateWait(threads);
        KafkaReads reads = new KafkaReads(MAX_READERS);
        ResourceConfig config = new ResourceConfig();
        config.property(ServerProperties.WADL_FEATURE_DISABLE, true);
        config.property(ServerProperties.LOCATION_HEADER_RELATIVE_URI_RESOLUTION_DISABLED, true);
        List<Object> resources = List.of(
                new DomainsResource(view, managers),
                new MissionsResource(view, managers, credentials, waits),
                new TemplatesResource(view, managers),
                new DevicesResource(view, managers, dependencies),
                new ReplaysResource(replays, managers, waits),
                new ReplayFeedResource(replays, feeds, description),
                new EventsResource(view, feeds, description),
                new RecordingsResource(view, events, markers, managers, threads),
                new RecordedEventsResource(control.replays().mongo(), managers),
                new MarkersResource(markers, managers),
                new AlarmsResource(view, managers),
                new FieldsResource(control.client(), managers, fields),
                new DeadLettersResource(control.client(), managers, reads),
                new TopicsResource(control.client(), reads),
                new CatalogResource(control.client(), reads),
                new AuditResource(view, control.client()),
                new CallerResource(),
                new HealthResource(readiness, metrics, description));
        resources.forEach(resource -> config.register(resource.getClass()));
        config.register(new Instances(resources));
        config.register(metrics);
        config.register(new VersionFilter());
        config.register(new PatchOverrideFilter());
        config.register(new UnknownNameFilter(description));
        config.register(new PageFilter(description));
        config.register(new IsoTimeFilter(description));
        config.register(new JsonBodyReader.Drain());
        config.register(new JsonResponses.HeadLength());
        config.register(new JsonExceptionMapper());
        if (tokens != null) {
            config.register(tokens);
            config.register(RoleFilter.class);
        }
        return config;
    }

    /** Binds resources as instances, because Jersey warns if instances are registered directly. */
    private static final class Instances extends AbstractBinder {
        private final List<Object> instances;

        Instances(List<Object> instances) {
            this.instances = instances;
        }

        @Override
        protected void configure() {
            instances.forEach(each -> bind(each).to((Type) each.getClass()));
        }
    }

    private void listen(RestSettings rest, TlsListener tls, ResourceConfig resources) throws IOException {
        HttpConfiguration http = AccessHandler.configuration();
        ServerConnector connector = tls == null
                ? new ServerConnector(server, new HttpConnectionFactory(http))
                : new ServerConnector(server, tls.protocols(http));
        connector.setHost(rest.host());
        connector.setPort(rest.port());
        server.addConnector(connector);
        server.setStopTimeout(STOP_TIMEOUT_MS);
        threads.setName("control-plane-rest");
        ServletHolder servlet = new ServletHolder(new ServletContainer(resources));
        servlet.setAsyncSupported(true);
        ServletContextHandler context = new ServletContextHandler("/");
        context.getServletHandler().setDecodeAmbiguousURIs(true);
        context.addServlet(servlet, "/*");
        context.setErrorHandler(RestApi::reject);
        server.setErrorHandler(RestApi::reject);
        AccessRule rule = AccessRule.allowing(rest.allowed(), OptionNames.FLAGS)
                .servedAs(rest.host())
                .withProbes("/health", "/ready");
        GzipHandler compressed = new GzipHandler(ApiPage.before(context));
        compressed.setMinGzipSize(MIN_COMPRESSED_BYTES);
        compressed.setIncludedMethods("GET", "POST", "PATCH", "DELETE"); // of these it restores the tag in If-Match
        // Applies to requests with tokens too, because a page may have one that its user entered.
        server.setHandler(new AccessHandler(
                rule,
                ProblemDetails.TYPE,
                rejection -> ProblemDetails.of(
                        HttpStatus.FORBIDDEN_403, CommandResult.ofError(rejection.error(), rejection.reason())),
                compressed));
        try {
            server.start();
        } catch (Exception e) { // Jetty declares no narrower type
            throw new IOException(
                    "The REST API cannot listen on %s:%d (%s). Choose another port."
                            .formatted(rest.host(), rest.port(), FailureText.of(e)),
                    e);
        }
        if (tls != null) {
            tls.watch(server);
        }
    }

    /** Answers requests that the HTTP server itself rejects, such as ambiguous paths. */
    private static boolean reject(Request request, Response response, Callback callback) {
        String reason = HttpStatus.getMessage(response.getStatus());
        CommandResult rejection = CommandResult.ofError(
                reason.toLowerCase(Locale.ROOT).replace(' ', '-'), "the HTTP server rejects the request: " + reason);
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, ProblemDetails.TYPE);
        response.write(true, ByteBuffer.wrap(ProblemDetails.of(response.getStatus(), rejection)), callback);
        return true;
    }

    public URI uri() {
        ServerConnector connector = (ServerConnector) server.getConnectors()[0];
        String scheme = connector.getConnectionFactory(SslConnectionFactory.class) == null ? "http" : "https";
        return URI.create(scheme + "://" + connector.getHost() + ":" + connector.getLocalPort());
    }

    /** Returns the metrics in the text format of Prometheus, for the port of probes. */
    public byte[] metrics() {
        return metrics.page();
    }

    public boolean isReady() {
        return view.isComplete();
    }

    @Override
    public void close() {
        feeds.close();
        try {
            server.stop();
        } catch (Exception e) { // Jetty declares no narrower type
            LOG.warn("the REST API did not stop in order", e);
        }
        reader.close();
        markers.close();
        if (events != null) {
            events.close();
            history.close();
        }
        managers.close();
    }
}
