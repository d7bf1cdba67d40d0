package io.furrow.control.rest.access;

import java.io.IOException;
import java.util.Optional;
import java.util.concurrent.TimeUnit;

import org.eclipse.jetty.http.HttpVersion;
import org.eclipse.jetty.server.ConnectionFactory;
import org.eclipse.jetty.server.HttpConfiguration;
import org.eclipse.jetty.server.HttpConnectionFactory;
import org.eclipse.jetty.server.SecureRequestCustomizer;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.SslConnectionFactory;
import org.eclipse.jetty.util.ssl.SslContextFactory;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.file.ReloadedFile;

/**
 * Provides TLS 1.2 and 1.3 for HTTP. When the files of the certificate change, new connections use the new one and
 * existing connections continue. While the files are unusable, the previous certificate stays in use.
 */
public final class TlsListener {
    private static final Logger LOG = LoggerFactory.getLogger(TlsListener.class);
    private static final long CHECK_SECONDS = 1;

    private final ReloadedFile<CertificateFiles.Content> files;
    private final SslContextFactory.Server context = new SslContextFactory.Server();
    private CertificateFiles.Content current;

    private TlsListener(ReloadedFile<CertificateFiles.Content> files) {
        this.files = files;
        this.current = files.get();
        use(context, current);
        context.setIncludeProtocols("TLSv1.3", "TLSv1.2");
    }

    public static TlsListener open(CertificateFiles files) throws IOException {
        return new TlsListener(ReloadedFile.open(files.all(), files::read, LOG::warn));
    }

    private static void use(SslContextFactory context, CertificateFiles.Content content) {
        context.setKeyStore(content.keys());
        context.setKeyManagerPassword(content.password());
    }

    /** Returns the protocols of a connector, the outermost first. */
    public ConnectionFactory[] protocols(HttpConfiguration http) {
        SecureRequestCustomizer secure = new SecureRequestCustomizer();
        // The client compares certificate and name; the access rule of the API checks the host.
        secure.setSniHostCheck(false);
        http.addCustomizer(secure);
        return new ConnectionFactory[] {
            new SslConnectionFactory(context, HttpVersion.HTTP_1_1.asString()), new HttpConnectionFactory(http)
        };
    }

    /** Checks the files periodically while the server runs. */
    public void watch(Server server) {
        server.getScheduler()
                .schedule(
                        () -> {
                            reload();
                            if (server.isRunning()) {
                                watch(server);
                            }
                        },
                        CHECK_SECONDS,
                        TimeUnit.SECONDS);
    }

    private void reload() {
        CertificateFiles.Content newest = files.get();
        if (newest != current) {
            try {
                context.reload(each -> use(each, newest));
                LOG.info("the REST API has a new certificate");
            } catch (Exception e) { // Jetty declares no narrower type
                LOG.warn("the new certificate of the REST API cannot be used; the previous one stays in use", e);
            }
            current = newest;
        }
    }

    /** Returns why the current files are not in use; empty if they are. */
    Optional<String> problem() {
        return files.problem();
    }
}
