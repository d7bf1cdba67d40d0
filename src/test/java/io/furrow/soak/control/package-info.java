/** Long checks of the control plane: random requests while its servers are killed or disconnected. */
package io.furrow.soak.control;
