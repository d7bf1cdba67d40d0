package io.furrow.simulators.mqtt;

import java.io.IOException;
import java.io.InputStream;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.security.KeyStore;
import java.security.cert.Certificate;
import java.security.cert.CertificateFactory;
import javax.net.ssl.SSLContext;
import javax.net.ssl.SSLSocketFactory;
import javax.net.ssl.TrustManagerFactory;

import org.eclipse.paho.client.mqttv3.MqttException;

/**
 * Address, trust and QoS of an MQTT broker.
 *
 * @param broker {@code tcp://host:port}, or {@code ssl://host:port} with TLS; also {@code mqtt} and {@code mqtts}
 * @param trusted PEM file with trusted certificates; null for those of the JDK
 * @param qos of measures, 0 or 1: with 0 they are lost while the connection is broken
 */
public record MqttAccess(URI broker, Path trusted, int qos) {
    public MqttAccess {
        broker = URI.create(broker.toString().replaceFirst("^mqtt:", "tcp:").replaceFirst("^mqtts:", "ssl:"));
        if (!"tcp".equals(broker.getScheme()) && !"ssl".equals(broker.getScheme())) {
            throw new IllegalArgumentException(
                    broker + " is not an address of an MQTT broker: use tcp://host:port, or ssl://host:port with TLS");
        }
        if (qos != 0 && qos != 1) {
            throw new IllegalArgumentException("QoS is 0 or 1, not " + qos);
        }
    }

    /** User and password; the password is left out of {@link #toString()}. */
    public record Login(String user, String password) {
        @Override
        public String toString() {
            return user;
        }
    }

    boolean isEncrypted() {
        return broker.getScheme().equals("ssl");
    }

    /**
     * TLS sockets that trust the configured certificates.
     *
     * @throws IOException naming the file, if it holds no certificate
     */
    public SSLSocketFactory encryptedSockets() throws IOException {
        try {
            SSLContext tls = SSLContext.getInstance("TLS");
            tls.init(null, trusted == null ? null : trust().getTrustManagers(), null);
            return new NoDelayEncryptedSockets(tls.getSocketFactory());
        } catch (GeneralSecurityException e) {
            throw new IOException(trusted + " holds no certificates in PEM that TLS could trust", e);
        }
    }

    /** Why a connection was not opened: names broker and user, and what to check. */
    String refusal(Login login, MqttException e) {
        return switch (e.getReasonCode()) {
            case MqttException.REASON_CODE_FAILED_AUTHENTICATION, MqttException.REASON_CODE_NOT_AUTHORIZED ->
                "the MQTT broker %s refuses user '%s': check user name and password".formatted(broker, login.user());
            case MqttException.REASON_CODE_CLIENT_TIMEOUT ->
                "the MQTT broker %s does not answer user '%s'".formatted(broker, login.user());
            default ->
                "no connection to the MQTT broker %s as user '%s': is it running%s?"
                        .formatted(broker, login.user(), isEncrypted() ? ", and is its certificate trusted" : "");
        };
    }

    private TrustManagerFactory trust() throws GeneralSecurityException, IOException {
        KeyStore store = KeyStore.getInstance(KeyStore.getDefaultType());
        store.load(null, null);
        try (InputStream pem = Files.newInputStream(trusted)) {
            for (Certificate each : CertificateFactory.getInstance("X.509").generateCertificates(pem)) {
                store.setCertificateEntry("trusted-" + store.size(), each);
            }
        }
        if (store.size() == 0) {
            throw new GeneralSecurityException("no certificate in the file");
        }
        TrustManagerFactory trust = TrustManagerFactory.getInstance(TrustManagerFactory.getDefaultAlgorithm());
        trust.init(store);
        return trust;
    }
}
