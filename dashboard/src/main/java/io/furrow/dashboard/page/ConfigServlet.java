package io.furrow.dashboard.page;

import java.io.IOException;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.servlet.http.HttpServlet;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.result.AnalyticsKind;

/** {@code GET /config.json}: settings of this server for the page. */
public final class ConfigServlet extends HttpServlet {
    private static final long serialVersionUID = 1L;

    private final byte[] config;

    public ConfigServlet(PageSettings settings) {
        ObjectNode node = NgsiJson.object();
        node.put("tiles", settings.tiles());
        node.put("tileFile", settings.tileFile() == null ? null : TileFile.PATH);
        node.put("signIn", settings.signIn());
        node.put("signOut", settings.signOut());
        node.set("analytics", NgsiJson.mapper().valueToTree(AnalyticsKind.jobNames()));
        String version = ConfigServlet.class.getPackage().getImplementationVersion();
        node.put("version", version == null ? "development" : version);
        this.config = NgsiJson.write(node);
    }

    @Override
    protected void doGet(HttpServletRequest request, HttpServletResponse response) throws IOException {
        response.setContentType("application/json");
        response.setHeader("Cache-Control", "no-cache");
        response.getOutputStream().write(config);
    }
}
