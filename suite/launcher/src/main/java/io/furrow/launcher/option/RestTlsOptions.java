package io.furrow.launcher.option;

import java.nio.file.Path;

import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.control.rest.access.CertificateFiles;

/** Options to secure the REST API for access from other machines. */
public final class RestTlsOptions {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--api-certificate",
            paramLabel = "FILE",
            description =
                    "Serve the REST API over TLS with this certificate chain, PEM. With --api-certificate-key. Read again when it changes.")
    private Path certificate;

    @Option(names = "--api-certificate-key", paramLabel = "FILE", description = "Its key, PEM (PKCS #8).")
    private Path key;

    @Option(
            names = "--api-keystore",
            paramLabel = "FILE",
            description = "Certificate and key in a PKCS #12 keystore instead. With --api-keystore-password-file.")
    private Path keystore;

    @Option(
            names = "--api-keystore-password-file",
            paramLabel = "FILE",
            description = "File whose first line is the password of the keystore, or of an encrypted key in PEM.")
    private Path password;

    @Option(
            names = "--api-insecure",
            description =
                    "Listen on addresses that other machines reach without TLS, because a proxy in front terminates it.")
    public boolean insecure;

    /** Null without TLS. */
    public CertificateFiles certificate() {
        if (certificate == null && key == null && keystore == null && password == null) {
            return null;
        }
        try {
            return new CertificateFiles(certificate, key, keystore, password);
        } catch (IllegalArgumentException e) {
            throw new ParameterException(
                    spec.commandLine(),
                    "TLS needs --api-certificate with --api-certificate-key, or --api-keystore with --api-keystore-password-file",
                    e);
        }
    }
}
