package io.furrow.control.rest;

import java.io.IOException;
import java.lang.reflect.Type;
import java.net.InetAddress;
import java.net.URI;
import java.nio.ByteBuffer;
import java.util.List;
import java.util.Locale;
import java.util.function.Supplier;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.core.MediaType;
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
import io.furrow.model.ngsi.NgsiJson;

/**
 * The REST API of the control plane. It shares nothing with the managers but their topics, so any number of instances, beside
 * the managers or away from them, answer alike.
 */
public final class RestApi implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(RestApi.class);
    private static final int THREADS = 32;
    private static final long STOPPING_MS = 2000;

    private final QueuedThreadPool threads = new QueuedThreadPool(THREADS);
    private final ServiceView view = new ServiceView();
    private final Answers answers = new Answers();
    private final Server server = new Server(threads);
    private final ServiceReader reader;
    private final Managers managers;

    private RestApi(ControlSettings control, RestSettings rest) {
        // A manager may remember an id by a twelfth longer than was asked for.
        reader = new ServiceReader(
                control.client(), control.remembered().multipliedBy(13).dividedBy(12), view, answers);
        managers = new Managers(control.client(), answers, view, rest.patience(), threads);
    }

    /**
     * Prepares the topics and listens; until they are read, requests are answered with 503.
     *
     * @param state that of the managers in this process, {@code RUNNING} when they answer
     * @throws IOException if the topics cannot be prepared, the tokens not be read, or the port is taken
     */
    public static RestApi start(ControlSettings control, RestSettings rest, Supplier<String> state) throws IOException {
        if (rest.tokens() == null && !InetAddress.getByName(rest.host()).isLoopbackAddress()) {
            throw new IOException(
                    "The REST API listens on %s only with tokens: whoever reaches it commands the farm. Name a"
                                    .formatted(rest.host())
                            + " file of lines '<name> <token>', or listen on 127.0.0.1.");
        }
        BearerTokens tokens = rest.tokens() == null ? null : BearerTokens.read(rest.tokens());
        ServiceTopics.prepare(control);
        RestApi api = new RestApi(control, rest);
        try {
            api.listen(rest, api.resources(control, rest, state, tokens));
        } catch (IOException e) {
            api.close();
            throw e;
        }
        api.reader.start();
        LOG.info("the REST API of the control plane listens on {}", api.uri());
        return api;
    }

    private ResourceConfig resources(
            ControlSettings control, RestSettings rest, Supplier<String> state, BearerTokens tokens)
            throws IOException {
        RestMetrics metrics = new RestMetrics(view, answers);
        DeviceCommands commands = rest.contextBroker() == null
                ? null
                : new DeviceCommands(rest.contextBroker(), control.missions().scope());
        DevicesResource.Means means =
                new DevicesResource.Means(control.missions().scope(), commands, rest.secret());
        ResourceConfig config = new ResourceConfig();
        config.property(ServerProperties.WADL_FEATURE_DISABLE, true);
        List<Object> resources = List.of(
                new DomainsResource(view, managers),
                new MissionsResource(view, managers),
                new TemplatesResource(view, managers),
                new DevicesResource(view, managers, means),
                new ReplaysResource(view, managers),
                new AlarmsResource(view, managers),
                new AuditResource(view),
                new ServicePages(view, state, metrics));
        resources.forEach(resource -> config.register(resource.getClass()));
        config.register(new Instances(resources));
        config.register(metrics);
        config.register(new Failures());
        config.register(new OwnPagesOnly(rest.host(), tokens != null));
        if (tokens != null) {
            config.register(tokens);
        }
        return config;
    }

    /** Jersey warns of resources that are registered as instances, though it takes them. */
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

    private void listen(RestSettings rest, ResourceConfig resources) throws IOException {
        HttpConfiguration http = new HttpConfiguration();
        http.setSendServerVersion(false);
        ServerConnector connector = new ServerConnector(server, new HttpConnectionFactory(http));
        connector.setHost(rest.host());
        connector.setPort(rest.port());
        server.addConnector(connector);
        server.setStopTimeout(STOPPING_MS);
        threads.setName("control-plane-rest");
        ServletHolder servlet = new ServletHolder(new ServletContainer(resources));
        servlet.setAsyncSupported(true);
        ServletContextHandler context = new ServletContextHandler("/");
        context.addServlet(servlet, "/*");
        context.setErrorHandler(RestApi::refuse);
        server.setErrorHandler(RestApi::refuse);
        server.setHandler(context);
        try {
            server.start();
        } catch (Exception e) { // Jetty declares no narrower type
            throw new IOException(
                    "The REST API cannot listen on %s:%d (%s). Choose another port."
                            .formatted(rest.host(), rest.port(), e.getMessage()),
                    e);
        }
    }

    /** What comes no further than to the HTTP server, as a path that has two readings. */
    private static boolean refuse(Request request, Response response, Callback callback) {
        String reason = HttpStatus.getMessage(response.getStatus());
        ObjectNode json = io.furrow.model.control.Response.of(io.furrow.model.control.Response.ERROR)
                .with("error", reason.toLowerCase(Locale.ROOT).replace(' ', '-'))
                .with("reason", "the HTTP server refuses the request: " + reason)
                .json();
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, MediaType.APPLICATION_JSON);
        response.write(true, ByteBuffer.wrap(NgsiJson.write(json)), callback);
        return true;
    }

    /** Where it listens. */
    public URI uri() {
        ServerConnector connector = (ServerConnector) server.getConnectors()[0];
        return URI.create("http://%s:%d".formatted(connector.getHost(), connector.getLocalPort()));
    }

    /** Whether what there is can be read. */
    public boolean isReady() {
        return view.isComplete();
    }

    @Override
    public void close() {
        try {
            server.stop();
        } catch (Exception e) { // Jetty declares no narrower type
            LOG.warn("the REST API did not stop in order", e);
        }
        reader.close();
        managers.close();
    }
}
