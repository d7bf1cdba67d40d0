package io.furrow.connect.source.http;

import java.net.InetSocketAddress;
import java.security.GeneralSecurityException;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLEngine;

import org.eclipse.jetty.util.ssl.SslContextFactory;

/** Provides Jetty with the TLS engines of Kafka's engine factory. */
public final class KafkaSslContextFactory extends SslContextFactory.Server {
    private final TlsEngines engines;

    public KafkaSslContextFactory(TlsEngines engines) {
        this.engines = engines;
        try {
            // Jetty requires a context to start; it creates no engine.
            SSLContext unused = SSLContext.getInstance("TLS");
            unused.init(null, null, null);
            setSslContext(unused);
        } catch (GeneralSecurityException e) {
            throw new IllegalStateException("every Java platform has TLS", e);
        }
    }

    @Override
    public SSLEngine newSSLEngine() {
        return engines.newEngine(null, -1);
    }

    @Override
    public SSLEngine newSSLEngine(String host, int port) {
        return engines.newEngine(host, port);
    }

    /** The client's address, not its name: a connection must not wait for a name server. */
    @Override
    public SSLEngine newSSLEngine(InetSocketAddress address) {
        return engines.newEngine(address.getHostString(), address.getPort());
    }

    @Override
    protected void doStop() throws Exception {
        super.doStop();
        engines.close();
    }
}
