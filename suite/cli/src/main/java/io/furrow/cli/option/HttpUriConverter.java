package io.furrow.cli.option;

import java.net.URI;
import java.net.URISyntaxException;

import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.TypeConversionException;

/**
 * Converts an option's value to an absolute {@code http} or {@code https} URL with a host, and rejects everything else
 * before anything starts.
 */
public final class HttpUriConverter implements ITypeConverter<URI> {
    @Override
    public URI convert(String text) {
        URI uri;
        try {
            uri = new URI(text);
        } catch (URISyntaxException e) {
            throw refused(text, "it is not a URI: " + e.getReason());
        }
        if (uri.getScheme() == null) {
            throw refused(text, "it has no scheme");
        } else if (!uri.getScheme().equalsIgnoreCase("http") && !uri.getScheme().equalsIgnoreCase("https")) {
            throw refused(text, "its scheme is '%s', not http or https".formatted(uri.getScheme()));
        } else if (uri.getHost() == null) {
            throw refused(text, "it has no host");
        } else if (uri.getPort() > 65_535) {
            throw refused(text, "there is no port " + uri.getPort());
        } else if (uri.getUserInfo() != null) {
            throw refused(text.replace(uri.getRawUserInfo() + "@", "…@"), "user and password in it would not be sent");
        }
        return uri;
    }

    private static TypeConversionException refused(String text, String reason) {
        return new TypeConversionException(
                "'%s' cannot be used, because %s; name a URL such as https://example.com/path".formatted(text, reason));
    }
}
