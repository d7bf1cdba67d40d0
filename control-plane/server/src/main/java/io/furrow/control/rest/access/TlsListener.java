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
 * TLS 1.2 and 1.3 in front of HTTP. When the files of the certificate change, new connections get the new one; those that stand go
 * on. Files that cannot be used leave the certificate from before.
 */
public final class TlsListener {
    private static final Logger LOG = LoggerFactory.getLogger(TlsListener.class);
    private static final long CHECK_SECONDS = 1;

    private final ReloadedFile<CertificateFiles.Content> files;
    private final SslContextFactory.Server context = new SslContextFactory.Server();
    private CertificateFiles.Content used;

    private TlsListener(ReloadedFile<CertificateFiles.Content> files) {
        this.files = files;
        this.used = files.get();
        use(context, used);
        context.setIncludeProtocols("TLSv1.3", "TLSv1.2");
    }

    /** @throws IOException as {@link CertificateFiles#read} */
    public static TlsListener open(CertificateFiles files) throws IOException {
        return new TlsListener(ReloadedFile.open(files.all(), files::read, LOG::warn));
    }

    private static void use(SslContextFactory context, CertificateFiles.Content content) {
        context.setKeyStore(content.keys());
        context.setKeyManagerPassword(content.password());
    }

    /** What a connector speaks, the outermost protocol first. */
    public ConnectionFactory[] protocols(HttpConfiguration http) {
        SecureRequestCustomizer secure = new SecureRequestCustomizer();
        // The certificate is compared with the name by the client; which names are served, the filters of the API say.
        secure.setSniHostCheck(false);
        http.addCustomizer(secure);
        return new ConnectionFactory[] {
            new SslConnectionFactory(context, HttpVersion.HTTP_1_1.asString()), new HttpConnectionFactory(http)
        };
    }

    /** Follows the files for as long as the server runs. */
    public void follow(Server server) {
        server.getScheduler()
                .schedule(
                        () -> {
                            reload();
                            if (server.isRunning()) {
                                follow(server);
                            }
                        },
                        CHECK_SECONDS,
                        TimeUnit.SECONDS);
    }

    private void reload() {
        CertificateFiles.Content newest = files.get();
        if (newest != used) {
            try {
                context.reload(each -> use(each, newest));
                LOG.info("the REST API has a new certificate");
            } catch (Exception e) { // Jetty declares no narrower type
                LOG.warn("the new certificate of the REST API cannot be used; the previous one stays in use", e);
            }
            used = newest;
        }
    }

    /** Why the files as they are now are not in use; empty if they are. */
    Optional<String> problem() {
        return files.problem();
    }
}
