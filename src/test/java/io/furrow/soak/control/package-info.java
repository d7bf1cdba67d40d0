/** Long checks of the control plane: random requests while what it depends on is killed or cut off. */
package io.furrow.soak.control;
