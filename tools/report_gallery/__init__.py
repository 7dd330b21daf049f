"""What tools/gallery is made of: the figures, how they are rendered, the page that shows them."""
