package io.furrow.launcher.option;

import java.util.List;

import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.Option;
import picocli.CommandLine.TypeConversionException;

import io.furrow.http.AllowedNames;

/** Options for the host names and origins that a command's HTTP servers accept. */
public final class AccessFlags {
    @Option(
            names = "--allowed-hosts",
            paramLabel = "HOST,…",
            split = ",",
            hideParamSyntax = true,
            converter = Host.class,
            description =
                    "Names or addresses by which the HTTP servers are reached, beside localhost, 127.0.0.0/8, [::1] and "
                            + "the address that they listen on. A request for another host is refused, as protection against DNS "
                            + "rebinding.")
    private List<String> hosts;

    @Option(
            names = "--allowed-origins",
            paramLabel = "ORIGIN,…",
            split = ",",
            hideParamSyntax = true,
            converter = Origin.class,
            description =
                    "Origins of web pages that may use the HTTP servers, for instance https://map.example.org. Default: only "
                            + "the servers' own pages.")
    private List<String> origins;

    public AllowedNames allowed() {
        return new AllowedNames(hosts == null ? List.of() : hosts, origins == null ? List.of() : origins);
    }

    private static final class Host implements ITypeConverter<String> {
        @Override
        public String convert(String value) {
            try {
                AllowedNames.requireHost(value);
                return value;
            } catch (IllegalArgumentException e) {
                throw new TypeConversionException(e.getMessage());
            }
        }
    }

    private static final class Origin implements ITypeConverter<String> {
        @Override
        public String convert(String value) {
            try {
                AllowedNames.requireOrigin(value);
                return value;
            } catch (IllegalArgumentException e) {
                throw new TypeConversionException(e.getMessage());
            }
        }
    }
}
