package io.furrow.embedded;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.GeneralSecurityException;
import java.security.KeyStore;
import java.util.ArrayList;
import java.util.Base64;
import java.util.List;

/**
 * A self-signed certificate for 127.0.0.1 and localhost with its key, for tests of TLS, made by the JDK's keytool.
 *
 * @param certificate in PEM
 * @param key in PEM, PKCS #8
 * @param keystore both, PKCS #12
 * @param password file with that of the keystore
 */
public record SelfSignedCertificate(Path certificate, Path key, Path keystore, Path password) {
    private static final String PASSWORD = "changeit";
    private static final String ALIAS = "server";

    /** @throws IOException if keytool fails; with its output */
    public static SelfSignedCertificate make(Path directory, String name) throws IOException {
        Path keystore = directory.resolve(name + ".p12");
        List<String> words = new ArrayList<>(List.of("-keystore", keystore.toString(), "-dname", "CN=" + name));
        words.addAll(List.of(("-genkeypair -storetype PKCS12 -keyalg EC -ext san=ip:127.0.0.1,dns:localhost -storepass "
                        + PASSWORD + " -alias " + ALIAS)
                .split(" ")));
        keytool(words);
        try {
            KeyStore keys = KeyStore.getInstance(keystore.toFile(), PASSWORD.toCharArray());
            return new SelfSignedCertificate(
                    pem(
                            directory.resolve(name + ".pem"),
                            "CERTIFICATE",
                            keys.getCertificate(ALIAS).getEncoded()),
                    pem(
                            directory.resolve(name + ".key"),
                            "PRIVATE KEY",
                            keys.getKey(ALIAS, PASSWORD.toCharArray()).getEncoded()),
                    keystore,
                    Files.writeString(directory.resolve(name + ".password"), PASSWORD + "\n"));
        } catch (GeneralSecurityException e) {
            throw new IOException(keystore + " cannot be read", e);
        }
    }

    private static Path pem(Path file, String what, byte[] der) throws IOException {
        String text = Base64.getMimeEncoder(64, new byte[] {'\n'}).encodeToString(der);
        return Files.writeString(file, "-----BEGIN %s-----\n%s\n-----END %s-----\n".formatted(what, text, what));
    }

    private static void keytool(List<String> words) throws IOException {
        List<String> command = new ArrayList<>(words);
        command.add(
                0, Path.of(System.getProperty("java.home"), "bin", "keytool").toString());
        Process process = new ProcessBuilder(command).redirectErrorStream(true).start();
        String output = new String(process.getInputStream().readAllBytes(), StandardCharsets.UTF_8);
        try {
            if (process.waitFor() != 0) {
                throw new IOException("keytool failed: " + output);
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IOException("interrupted while keytool ran", e);
        }
    }
}
